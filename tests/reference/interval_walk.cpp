#include "plume/tests/reference/interval_walk.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace plume::reference {
namespace {

constexpr double kTolerance = 1e-11;

int sign(double x) { return (x > 0) - (x < 0); }

class Walk {
 public:
  Walk(const Classification& classification, bool linear)
      : classification_(classification), linear_(linear) {
    for (const auto& interval : classification.intervals) {
      breaks_.push_back(interval.low);
      breaks_.push_back(interval.high);
    }
    for (const auto& surface : classification.isosurfaces) breaks_.push_back(surface.value);
    std::sort(breaks_.begin(), breaks_.end());
    breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
    for (std::size_t i = 1; i < breaks_.size(); ++i)
      cuts_.push_back((breaks_[i - 1] + breaks_[i]) / 2);
  }

  void start(double s) {
    const int inside = interval_at(s);
    if (inside < 0) return;
    // Section 6.4: the derivative is taken as positive, and the whole range is rendered.
    mono_ = 1;
    add_interval(inside, low(inside), high(inside));
    threshold_ = high(inside);
  }

  void add(const LinearPiece& piece) {
    std::vector<double> places{piece.s_in, piece.s_out};
    for (const double cut : cuts_)
      if ((cut - piece.s_in) * (cut - piece.s_out) < 0) places.push_back(cut);
    std::sort(places.begin(), places.end());
    if (piece.s_out < piece.s_in) std::reverse(places.begin(), places.end());
    const double way = std::abs(piece.s_out - piece.s_in);
    for (std::size_t i = 1; i < places.size(); ++i)
      subsegment(places[i - 1], places[i],
                 piece.length * (way > 0 ? std::abs(places[i] - places[i - 1]) / way : 1));
  }

  Radiance result() const { return {rgb_, 1 - transmittance_, 0}; }

 private:
  double low(int i) const { return classification_.intervals[static_cast<std::size_t>(i)].low; }
  double high(int i) const { return classification_.intervals[static_cast<std::size_t>(i)].high; }

  int interval_at(double s) const {
    for (std::size_t i = 0; i < classification_.intervals.size(); ++i)
      if (low(static_cast<int>(i)) <= s && s <= high(static_cast<int>(i)))
        return static_cast<int>(i);
    return -1;
  }

  void subsegment(double s_f, double s_b, double length) {
    const int front = interval_at(s_f), back = interval_at(s_b);
    const int direction = sign(s_b - s_f);
    const double to_length = s_b != s_f ? length / std::abs(s_b - s_f) : 0;
    std::optional<Isosurface> surface;
    for (const Isosurface& candidate : classification_.isosurfaces)
      if ((candidate.value - s_f) * (candidate.value - s_b) < 0) surface = candidate;

    if (front < 0 && back < 0) {
      if (!surface) {
        add_volume(s_f, s_b, length);
        return;
      }
      const double v = surface->value;
      add_volume(s_f, v, std::abs(v - s_f) * to_length);
      add_surface(*surface);
      add_volume(v, s_b, std::abs(s_b - v) * to_length);
    } else if (front == back) {
      if (!surface) {
        monotone(front, s_f, s_b);
        return;
      }
      monotone(front, s_f, surface->value);
      add_surface(*surface);
      monotone(front, surface->value, s_b);
    } else if (front < 0) {  // enters
      const double end = direction > 0 ? low(back) : high(back);
      add_volume(s_f, end, std::abs(end - s_f) * to_length);
      enter(direction, end);
      monotone(back, end, s_b);
    } else if (back < 0) {  // leaves
      const double end = direction > 0 ? high(front) : low(front);
      monotone(front, s_f, end);
      mono_ = 0;
      add_volume(end, s_b, std::abs(s_b - end) * to_length);
    } else {  // from one interval into another that touches it
      const double common = direction > 0 ? high(front) : low(front);
      monotone(front, s_f, common);
      enter(direction, common);
      monotone(back, common, s_b);
    }
  }

  void enter(int direction, double end) {
    mono_ = direction;
    threshold_ = end;
    shown_ = 0;
  }

  // The part of an interval's subsegment that does not violate monotonicity.
  void monotone(int interval, double s_f, double s_b) {
    const double begin = mono_ > 0 ? std::max(s_f, threshold_) : std::min(s_f, threshold_);
    if (mono_ > 0 ? s_b <= begin : s_b >= begin) return;
    add_interval(interval, begin, s_b);
    threshold_ = s_b;
  }

  void add_volume(double s_f, double s_b, double length) {
    if (!classification_.volume || !(length > 0)) return;
    composite(integrate_linear(*classification_.volume, s_f, s_b, length, kTolerance));
  }

  void add_surface(const Isosurface& surface) {
    Radiance radiance;
    for (std::size_t c = 0; c < 3; ++c)
      radiance.rgb[c] = static_cast<double>(surface.opacity) * surface.color[c];
    radiance.alpha = surface.opacity;
    composite(radiance);
  }

  void add_interval(int interval, double s_f, double s_b) {
    const double width = high(interval) - low(interval);
    const double w_f = (s_f - low(interval)) / width, w_b = (s_b - low(interval)) / width;
    const auto& profile = classification_.intervals[static_cast<std::size_t>(interval)].profile;
    if (!linear_) {
      composite(integrate_linear(profile, w_f, w_b, std::abs(w_b - w_f), kTolerance));
      return;
    }
    // Equations 12 and 13, right sides: a medium so thin that it does not attenuate itself.
    constexpr double kThin = 1e-7;
    TransferFunction thin = profile;
    for (auto& knot : thin.knots) knot.optics.extinction *= static_cast<float>(kThin);
    Radiance part = integrate_linear(thin, w_f, w_b, std::abs(w_b - w_f), kTolerance);
    for (double& channel : part.rgb) channel /= kThin;
    part.alpha = part.optical_depth / kThin;
    // Equations 30 and 31.
    const double before = shown_;
    shown_ += part.alpha;
    for (double& channel : part.rgb) channel /= 1 - before;
    part.alpha /= 1 - before;
    composite(part);
  }

  void composite(const Radiance& part) {
    for (std::size_t c = 0; c < 3; ++c) rgb_[c] += transmittance_ * part.rgb[c];
    transmittance_ *= 1 - part.alpha;
  }

  const Classification& classification_;
  bool linear_;
  std::vector<double> breaks_, cuts_;
  int mono_ = 0;  // off
  double threshold_ = 0;
  double shown_ = 0;  // opacity of the visit so far, linear form
  std::array<double, 3> rgb_{0, 0, 0};
  double transmittance_ = 1;
};

}  // namespace

Radiance interval_walk(const Classification& classification, const std::vector<LinearPiece>& pieces,
                       bool linear) {
  Walk walk(classification, linear);
  if (!pieces.empty()) walk.start(pieces.front().s_in);
  for (const LinearPiece& piece : pieces) walk.add(piece);
  return walk.result();
}

}  // namespace plume::reference
