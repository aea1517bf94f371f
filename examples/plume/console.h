/// How the command talks: messages and a progress bar on standard error, results in files.
#pragma once

#include <functional>
#include <string>

namespace plume::command {

/// Messages for people; silent where `quiet`.
class Console {
 public:
  explicit Console(bool quiet) : quiet_(quiet) {}

  void say(const std::string& line) const;

  /// A progress bar for render(), none where standard error is no terminal or `quiet`.
  std::function<bool(double)> progress_bar() const;

  /// A line that takes the place of the one before, empty to clear it; likewise.
  void progress_line(const std::string& line) const;

 private:
  bool quiet_;
};

/// "12,345"
std::string with_separators(std::size_t number);

/// The most memory that this process has held, in bytes.
std::size_t peak_memory_bytes();

}  // namespace plume::command
