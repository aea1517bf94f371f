#include "plume/lib/fitted_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plume {
namespace {

constexpr std::size_t kBins = 32;
constexpr double kMostOpaque = 0.9;

}  // namespace

std::vector<float> sample_for_map(std::span<const float> values) {
  const std::size_t stride = std::max<std::size_t>(1, values.size() / 100000);
  std::vector<float> sample;
  sample.reserve(values.size() / stride + 1);
  for (std::size_t i = 0; i < values.size(); i += stride) sample.push_back(values[i]);
  return sample;
}

ColorMap fitted_color_map(std::span<const float> values,
                          const std::optional<std::array<double, 2>>& range) {
  std::vector<float> sample = sample_for_map(values);
  std::erase_if(sample, [](float value) { return std::isnan(value); });
  std::sort(sample.begin(), sample.end());

  ColorMap map = *preset("turbo");
  if (sample.empty() || (sample.front() == sample.back() && !range)) {
    const double value = sample.empty() ? 0 : sample.front();
    const double margin = std::max(std::abs(value) * 1e-3, 1e-6);
    map = rescaled(std::move(map), value - margin, value + margin);
    map.opacities = {{value - margin, 0.5}, {value + margin, 0.5}};
    return map;
  }
  auto percentile = [&](double share) {
    return static_cast<double>(
        sample[static_cast<std::size_t>(share * static_cast<double>(sample.size() - 1))]);
  };
  double low = range ? (*range)[0] : percentile(0.01);
  double high = range ? (*range)[1] : percentile(0.99);
  if (!(low < high)) {
    low = sample.front();
    high = sample.back();
  }
  map = rescaled(std::move(map), low, high);

  std::array<double, kBins> share{};
  for (const float value : sample) {
    const double place = (value - low) / (high - low) * kBins;
    share[static_cast<std::size_t>(std::clamp(place, 0.0, kBins - 1.0))] +=
        1.0 / static_cast<double>(sample.size());
  }
  map.opacities.clear();
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    // A bin of the average share is a third as opaque as an empty one; a full one is clear.
    const double crowd = share[bin] * kBins;
    const double opacity = kMostOpaque / (1 + 2 * crowd * crowd);
    const double x = low + (high - low) * (static_cast<double>(bin) + 0.5) / kBins;
    map.opacities.push_back({x, opacity});
  }
  return map;
}

}  // namespace plume
