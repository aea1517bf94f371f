#include "console.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>

#include <fmt/format.h>

#include "plume/mesh/error.h"

namespace plume::command {

void Console::say(const std::string& line) const {
  if (!quiet_) std::cerr << line << '\n';
}

std::function<bool(double)> Console::progress_bar() const {
  if (quiet_ || isatty(STDERR_FILENO) == 0) return {};
  return [shown = -1](double share) mutable {
    constexpr int kWidth = 40;
    const int filled = static_cast<int>(std::floor(share * kWidth));
    if (filled != shown) {
      shown = filled;
      std::cerr << fmt::format("\r[{:=<{}}{:<{}}] {}%{}", "", filled, "", kWidth - filled,
                               static_cast<int>(share * 100), share >= 1 ? "\n" : "")
                << std::flush;
    }
    return true;
  };
}

std::string with_separators(std::size_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

std::size_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

void check_writable(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  if (std::filesystem::is_directory(file))
    throw Error(file + ": is a folder; name a file in it");
  if (!std::filesystem::is_directory(folder))
    throw Error(file + ": the folder " + folder.string() + " does not exist; make it first");
  const std::string probe = file + ".part";
  const bool writable = static_cast<bool>(std::ofstream(probe));
  std::error_code ignored;  // there may be nothing to remove
  std::filesystem::remove(probe, ignored);
  if (!writable) throw Error(file + ": cannot be written; check the folder's permissions");
}

void write_text_file(const std::string& file, const std::string& text) {
  const std::string part = file + ".part";
  bool good = false;
  {
    std::ofstream stream(part);
    stream << text;
    stream.close();
    good = static_cast<bool>(stream);
  }
  std::error_code failed;
  if (good) std::filesystem::rename(part, file, failed);
  if (good && !failed) return;
  std::filesystem::remove(part, failed);
  throw Error(file + ": could not be written; check the folder and the space on its disk");
}

}  // namespace plume::command
