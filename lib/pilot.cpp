#include "plume/lib/pilot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "plume/lib/planner.h"
#include "plume/lib/render_modes.h"

namespace plume {
namespace {

// Pixels along the longer side of the small version: one in four of the picture's, but no fewer and
// no more than these.
constexpr int kSmallest = 48, kLargest = 160;
constexpr int kWindow = 8;    // pixels along the sides of windows
constexpr int kWindows = 12;  // of these

}  // namespace

Pilot::Pilot(const Scene& scene, const Camera& camera, const RenderSettings& reference)
    : scene_(scene), camera_(camera), reference_(reference) {
  const int longer = std::max(reference.width, reference.height);
  const int aimed = std::clamp(longer / 4, kSmallest, kLargest);
  const double scale = std::min(1.0, static_cast<double>(aimed) / longer);
  // The aspect ratio need not be met: pixels are pixels.
  width_ = std::max(1, static_cast<int>(std::lround(scale * reference.width)));
  height_ = std::max(1, static_cast<int>(std::lround(scale * reference.height)));
  RenderResult result = render(scene, camera, small(reference));
  small_reference_ = std::move(result.image);
  shade_width_ = shade_width(result.statistics);
}

RenderSettings Pilot::small(RenderSettings settings) const {
  settings.width = width_;
  settings.height = height_;
  settings.window.reset();
  settings.depth_limit.clear();  // of the picture's pixels
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
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return error[a] > error[b]; });
  std::vector<Place> places;
  for (const std::size_t pixel : order) {
    if (!(error[pixel] > 0) || places.size() == kWindows) break;
    const Place place{static_cast<int>(pixel) % width_, static_cast<int>(pixel) / width_};
    // Not where another window lies already.
    const bool is_new = std::none_of(places.begin(), places.end(), [&](const Place& other) {
      return std::abs(other.x - place.x) <= 1 && std::abs(other.y - place.y) <= 1;
    });
    if (is_new) places.push_back(place);
  }
  return places;
}

PixelWindow Pilot::window_around(const Place& place) const {
  auto first = [](int at, int small_size, int size) {
    const int middle = static_cast<int>((at + 0.5) * size / small_size);
    return std::clamp(middle - kWindow / 2, 0, std::max(0, size - kWindow));
  };
  return {first(place.x, width_, reference_.width), first(place.y, height_, reference_.height),
          std::min(kWindow, reference_.width), std::min(kWindow, reference_.height)};
}

const Image& Pilot::reference_in(const PixelWindow& window) {
  const auto [found, is_new] = window_references_.try_emplace({window.x, window.y});
  if (is_new) {
    RenderSettings settings = reference_;
    settings.window = window;
    settings.channels.clear();
    found->second = render(scene_, camera_, settings).image;
  }
  return found->second;
}

double Pilot::error_of(const RenderSettings& settings) {
  const Image picture = render(scene_, camera_, small(settings)).image;
  double error = greatest_difference(picture, small_reference_, reference_.mode, shade_width_);
  pixels_ = picture.rgba.size() / 4;
  if (width_ == reference_.width && height_ == reference_.height) return error;
  for (const Place& place : worst_places(picture)) {
    RenderSettings here = settings;
    here.window = window_around(place);
    here.channels.clear();
    const Image there = render(scene_, camera_, here).image;
    error = std::max(error, greatest_difference(there, reference_in(*here.window), reference_.mode,
                                                shade_width_));
    pixels_ += there.rgba.size() / 4;
  }
  return error;
}

}  // namespace plume
