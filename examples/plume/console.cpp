#include "console.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <iostream>

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

void Console::progress_line(const std::string& line) const {
  if (!quiet_ && isatty(STDERR_FILENO) != 0)
    std::cerr << fmt::format("\r{:.100}\033[K", line) << std::flush;
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

}  // namespace plume::command
