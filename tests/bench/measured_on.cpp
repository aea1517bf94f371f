#include "plume/tests/bench/measured_on.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

#include "plume/traverse/packets.h"

namespace plume::bench {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) {
      const std::size_t colon = line.find(": ");
      if (colon != std::string::npos) return line.substr(colon + 2);
    }
  return "unknown processor";
}

}  // namespace

std::string measured_on() {
  double load = 0;
  getloadavg(&load, 1);
  return fmt::format("{:%Y-%m-%d}, {}, {} threads, {}, load {:.1f}",
                     fmt::localtime(std::time(nullptr)), processor(),
                     std::thread::hardware_concurrency(), packet_instruction_set(), load);
}

}  // namespace plume::bench
