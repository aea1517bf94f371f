/// How long things take.
#pragma once

#include <chrono>
#include <utility>

namespace plume::command {

class Stopwatch {
 public:
  /// Milliseconds since the last call, or since the watch was made.
  double lap() {
    const auto now = Clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(start_, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace plume::command
