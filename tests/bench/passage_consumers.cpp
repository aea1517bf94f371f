#include "plume/tests/bench/passage_consumers.h"

namespace plume::bench {

const char* mode_name(Mode mode) {
  constexpr const char* kNames[] = {"cells", "integral", "isosurface", "volume", "closed-form"};
  return kNames[static_cast<std::size_t>(mode)];
}

OpticsTable OpticsTable::ramp(float low, float high, float extinction) {
  constexpr std::size_t kEntries = 4096;
  OpticsTable table;
  table.low = low;
  table.per_scalar = high > low ? static_cast<float>(kEntries) / (high - low) : 0;
  for (std::size_t i = 0; i < kEntries; ++i) {
    const float x = (static_cast<float>(i) + 0.5f) / static_cast<float>(kEntries);
    const float white = 1 - std::abs(2 * x - 1);
    table.entries.push_back(
        {std::max(white, x), white, std::max(white, 1 - x), extinction * x * x});
  }
  return table;
}

TransferFunction ramp_of_knots(float low, float high, float extinction) {
  TransferFunction ramp;
  for (int i = 0; i < 8; ++i) {
    const float x = static_cast<float>(i) / 7;
    const float white = 1 - std::abs(2 * x - 1);
    ramp.knots.push_back(
        {low + x * (high - low),
         {extinction * x * x, {std::max(white, x), white, std::max(white, 1 - x)}}});
  }
  return ramp;
}

}  // namespace plume::bench
