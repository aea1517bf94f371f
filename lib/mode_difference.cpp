#include "plume/lib/mode_difference.h"

#include <algorithm>
#include <cmath>

#include "plume/lib/render_modes.h"

namespace plume {

double shade_width(const RenderStatistics& statistics) {
  if (!statistics.gray_range) return 0;
  const auto& [low, high] = *statistics.gray_range;
  return static_cast<double>(high) - low;
}

std::vector<double> differences(const Image& picture, const Image& reference, Mode mode,
                                double width) {
  std::vector<double> greatest(reference.rgba.size() / 4, 0);
  auto take = [&](std::size_t pixel, double a, double b, double unit) {
    if (std::isnan(a) && std::isnan(b)) return;
    const double difference = std::abs(a - b) / unit;
    greatest[pixel] = std::max(greatest[pixel], std::isnan(difference) ? 1.0 : difference);
  };
  for (std::size_t i = 0; i < reference.rgba.size(); ++i)
    if (width == 0 || i % 4 == 3) take(i / 4, picture.rgba[i], reference.rgba[i], 1);
  if (width == 0) return greatest;
  const char* const channel = in_words(mode).channel;
  const auto& values = picture.channel(channel)->values;
  const auto& right = reference.channel(channel)->values;
  for (std::size_t i = 0; i < greatest.size(); ++i)
    if (reference.rgba[4 * i + 3] != 0 && picture.rgba[4 * i + 3] != 0)
      take(i, values[i], right[i], width);
  return greatest;
}

double greatest_difference(const Image& picture, const Image& reference, Mode mode, double width) {
  const std::vector<double> all = differences(picture, reference, mode, width);
  return all.empty() ? 0 : *std::max_element(all.begin(), all.end());
}

}  // namespace plume
