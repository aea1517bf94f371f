#include "plume/lib/pilot.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "plume/lib/mode_difference.h"

namespace plume {
namespace {

// Pixels along the longer side of the small version: one in four of the picture's (or in eight),
// but no fewer and no more than these.
constexpr int kSmallest = 48, kLargest = 160;
constexpr int kWindow = 8;         // pixels along the sides of windows
constexpr int kMostSteps = 20;     // of a window uphill
constexpr std::size_t kRank = 12;  // of the place that the worst is compared with
constexpr double kSpread = 3;      // how many times their distance is added

}  // namespace

Pilot::Pilot(const Scene& scene, const Camera& camera, const RenderSettings& reference, Look look)
    : scene_(scene),
      camera_(camera),
      reference_(reference),
      windows_(look == Look::full ? 64 : 24) {
  reference_.window.reset();
  reference_.channels.clear();
  const int longer = std::max(reference.width, reference.height);
  const int aimed = std::clamp(longer / (look == Look::full ? 4 : 8), kSmallest, kLargest);
  const double scale = std::min(1.0, static_cast<double>(aimed) / longer);
  // The aspect ratio need not be met: pixels are pixels.
  width_ = std::max(1, static_cast<int>(std::lround(scale * reference.width)));
  height_ = std::max(1, static_cast<int>(std::lround(scale * reference.height)));
  // All of a picture that the windows would cover.
  const std::size_t pixels =
      static_cast<std::size_t>(reference.width) * static_cast<std::size_t>(reference.height);
  if (pixels <= windows_ * kWindow * kWindow) {
    width_ = reference.width;
    height_ = reference.height;
  }
  RenderResult result = render(scene, camera, small(reference_));
  small_reference_ = std::move(result.image);
  shade_width_ = shade_width(result.statistics);
}

RenderSettings Pilot::small(RenderSettings settings) const {
  if (settings.width != width_ || settings.height != height_)
    settings.depth_limit.clear();  // of the picture's pixels
  settings.width = width_;
  settings.height = height_;
  settings.window.reset();
  settings.channels.clear();
  settings.threads = 0;
  return settings;
}

std::vector<Pilot::Place> Pilot::worst_places(const std::vector<double>& errors) const {
  std::vector<std::size_t> order(errors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return errors[a] > errors[b]; });
  std::vector<Place> taken, places;
  auto in_picture = [](int at, int small_size, int size) {
    return static_cast<int>((at + 0.5) * size / small_size);
  };
  for (const std::size_t pixel : order) {
    if (!(errors[pixel] > 0) || places.size() == windows_) break;
    const Place place{static_cast<int>(pixel) % width_, static_cast<int>(pixel) / width_};
    // Not where another window lies already.
    const bool is_new = std::none_of(taken.begin(), taken.end(), [&](const Place& other) {
      return std::abs(other.x - place.x) <= 1 && std::abs(other.y - place.y) <= 1;
    });
    if (!is_new) continue;
    taken.push_back(place);
    places.push_back({in_picture(place.x, width_, reference_.width),
                      in_picture(place.y, height_, reference_.height)});
  }
  return places;
}

PixelWindow Pilot::window_around(const Place& place) const {
  auto first = [](int middle, int size) {
    return std::clamp(middle - kWindow / 2, 0, std::max(0, size - kWindow));
  };
  return {first(place.x, reference_.width), first(place.y, reference_.height),
          std::min(kWindow, reference_.width), std::min(kWindow, reference_.height)};
}

const Image& Pilot::reference_in(const PixelWindow& window) {
  {
    const std::lock_guard lock(guard_);
    const auto found = window_references_.find({window.x, window.y});
    if (found != window_references_.end()) return found->second;
  }
  RenderSettings settings = reference_;
  settings.window = window;
  settings.threads = 1;
  Image image = render(scene_, camera_, settings).image;
  const std::lock_guard lock(guard_);
  // Another thread may have been faster: with the same pixels.
  return window_references_.try_emplace({window.x, window.y}, std::move(image)).first->second;
}

double Pilot::climb_from(Place place, const RenderSettings& settings, std::size_t& pixels) {
  double greatest = -1;
  for (int step = 0; step < kMostSteps; ++step) {
    RenderSettings here = settings;
    here.window = window_around(place);
    const PixelWindow& window = *here.window;
    const Image picture = render(scene_, camera_, here).image;
    const std::vector<double> errors =
        differences(picture, reference_in(window), reference_.mode, shade_width_);
    pixels += errors.size();
    const auto worst = std::max_element(errors.begin(), errors.end());
    if (*worst <= greatest) break;
    greatest = *worst;
    const int at = static_cast<int>(worst - errors.begin());
    const int x = at % window.width, y = at / window.width;
    const bool at_rim = x == 0 || y == 0 || x == window.width - 1 || y == window.height - 1;
    if (!at_rim) break;
    place = {window.x + x, window.y + y};
  }
  return greatest;
}

PilotError Pilot::error_of(const RenderSettings& settings, double enough) {
  const Image picture = render(scene_, camera_, small(settings)).image;
  const std::vector<double> errors =
      differences(picture, small_reference_, reference_.mode, shade_width_);
  PilotError error;
  error.found = *std::max_element(errors.begin(), errors.end());
  error.estimate = error.found;
  error.pixels = errors.size();
  error.all = width_ == reference_.width && height_ == reference_.height;
  if (error.all || error.found > enough) return error;

  RenderSettings in_windows = settings;
  in_windows.channels.clear();
  in_windows.threads = 1;  // windows are looked at in parallel
  const std::vector<Place> places = worst_places(errors);
  std::vector<double> worst(places.size());
  std::vector<std::size_t> pixels(places.size(), 0);
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
    worst[i] = climb_from(places[i], in_windows, pixels[i]);
  });
  error.pixels = std::accumulate(pixels.begin(), pixels.end(), error.pixels);
  worst.resize(std::max(worst.size(), kRank), 0.0);
  std::sort(worst.begin(), worst.end(), std::greater<>());
  error.found = std::max(error.found, worst[0]);
  error.estimate = error.found + std::max(error.found, kSpread * (error.found - worst[kRank - 1]));
  return error;
}

}  // namespace plume
