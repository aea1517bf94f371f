/// Files that appear under their name only when they are whole.
#pragma once

#include <filesystem>
#include <string_view>

namespace plume {

/// A file to be: written under a hidden name beside its own, so that taking its place is one step,
/// and removed again unless it is kept.
class WholeFile {
 public:
  explicit WholeFile(std::filesystem::path target);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// Where to write.
  const std::filesystem::path& path() const { return path_; }
  /// Gives the file its name. Throws Error where that cannot be done.
  void keep();

 private:
  std::filesystem::path target_, path_;
  bool kept_ = false;
};

/// Writes a file, whole or not at all. Throws Error, naming the file and the reason.
void write_whole_file(const std::filesystem::path& file, std::string_view bytes);

/// Throws Error unless a file of that name could be written: its folder exists and is writable, and
/// the name is no folder's. Leaves nothing behind.
void check_writable(const std::filesystem::path& file);

}  // namespace plume
