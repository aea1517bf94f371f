#include "plume/lib/pilot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "plume/lib/planner.h"
#include "plume/lib/render_modes.h"

namespace plume {
namespace {

constexpr int kSmall = 48;   // pixels along the longer side of the small version
constexpr int kWindow = 8;   // and along the sides of windows
constexpr int kWindows = 6;  // of these

}  // namespace

Pilot::Pilot(const Scene& scene, const Camera& camera, const RenderSettings& reference)
    : scene_(scene), camera_(camera), reference_(reference) {
  const int longer = std::max(reference.width, reference.height);
  const double scale = std::min(1.0, static_cast<double>(kSmall) / longer);
  // The aspect ratio need not be met: pixels are pixels.
  width_ = std::max(1, static_cast<int>(std::lround(scale * reference.width)));
  height_ = std::max(1, static_cast<int>(std::lround(scale * reference.height)));
  small_reference_ = render(scene, camera, small(reference)).image;
  shade_width_ = shade_width(small_reference_, reference.mode);
}

RenderSettings Pilot::small(RenderSettings settings) const {
  settings.width = width_;
  settings.height = height_;
  settings.window.reset();
  settings.channels.clear();
  return settings;
}

std::vector<Pilot::Place> Pilot::worst_places(const Image& picture) const {
  const Channel* values = nullptr;
  if (const char* name = in_words(reference_.mode).channel) values = picture.channel(name);
  const std::size_t count = picture.rgba.size() / 4;
  std::vector<double> error(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    if (values != nullptr) {
      const double difference =
          values->values[i] - small_reference_.channel(values->name)->values[i];
      if (std::isfinite(difference)) error[i] = std::abs(difference);
      continue;
    }
    for (std::size_t c = 0; c < 4; ++c)
      error[i] = std::max<double>(
          error[i], std::abs(picture.rgba[4 * i + c] - small_reference_.rgba[4 * i + c]));
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto taken = std::min<std::size_t>(kWindows, count);
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(taken), order.end(),
                    [&](std::size_t a, std::size_t b) {
                      return error[a] != error[b] ? error[a] > error[b] : a < b;
                    });
  std::vector<Place> places;
  for (std::size_t k = 0; k < taken; ++k) {
    if (!(error[order[k]] > 0)) break;
    places.push_back({static_cast<int>(order[k]) % width_, static_cast<int>(order[k]) / width_});
  }
  return places;
}

double Pilot::error_of(const RenderSettings& settings) {
  const Image picture = render(scene_, camera_, small(settings)).image;
  double error = greatest_difference(picture, small_reference_, reference_.mode, shade_width_);
  pixels_ = picture.rgba.size() / 4;
  if (width_ == reference_.width && height_ == reference_.height) return error;
  for (const Place& place : worst_places(picture)) {
    // The window around the place that the small version's pixel shows.
    auto first = [](int at, int small_size, int size) {
      const int middle = static_cast<int>((at + 0.5) * size / small_size);
      return std::clamp(middle - kWindow / 2, 0, std::max(0, size - kWindow));
    };
    const PixelWindow window{
        first(place.x, width_, reference_.width), first(place.y, height_, reference_.height),
        std::min(kWindow, reference_.width), std::min(kWindow, reference_.height)};
    RenderSettings here = settings, right = reference_;
    here.window = right.window = window;
    here.channels.clear();
    right.channels.clear();
    error = std::max(error, greatest_difference(render(scene_, camera_, here).image,
                                                render(scene_, camera_, right).image,
                                                reference_.mode, shade_width_));
    pixels_ += static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height);
  }
  return error;
}

}  // namespace plume
