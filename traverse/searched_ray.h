/// What was found of a ray without walking along it, and whether it is what a walk would have met.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "plume/traverse/ray.h"
#include "plume/traverse/segment.h"

namespace plume {

/// Segments that matter, of which there are few, and the places where the ray crosses the boundary
/// up to the last of them. They come in any order; finish() sorts them and checks them. A ray that
/// fails, or that is too much for the lists, is declined: it must be walked.
class SearchedRay {
 public:
  static constexpr std::size_t kMostSegments = 16, kMostBoundaries = 12;

  void clear() {
    size_ = boundaries_ = cells_ = 0;
    declined_ = false;
  }
  void decline() { declined_ = true; }
  bool declined() const { return declined_; }

  /// A cell was looked at.
  void count() { ++cells_; }
  void add(const Segment& segment) {
    if (size_ == kMostSegments) return decline();
    segments_[size_++] = segment;
  }
  /// The ray comes in (or goes out) through the boundary at t, where the scalar is that.
  void cross_boundary(double t, float scalar, bool in) {
    if (boundaries_ == kMostBoundaries) return decline();
    crossings_[boundaries_++] = {t, scalar, in};
  }

  /// Front to back after finish().
  std::span<const Segment> segments() const { return {segments_.data(), size_}; }
  std::size_t entries() const { return entries_; }
  std::size_t cells() const { return cells_; }

  /// How far apart passages are that a picture may take for one, and that rounding may: world
  /// units.
  struct Gaps {
    double connected = 0, rounding = 0;
  };

  /// Sorts, and declines the ray unless: ways in and out through the boundary take turns, up to
  /// `last`, beyond which nothing was looked for; the first is a way in and not before t_min;
  /// passages that are `connected` have no value between them (of those for which
  /// `differ(float, float)` is true); no segment begins where rounding may have two passages
  /// overlap; all segments lie inside of passages, and none begins before the last one ends.
  template <class Differ>
  void finish(const Ray& ray, double last, const Gaps& gaps, const Differ& differ) {
    if (declined_) return;
    const auto boundaries = std::span(crossings_).first(boundaries_);
    std::sort(boundaries.begin(), boundaries.end(), [](const Boundary& a, const Boundary& b) {
      return a.t != b.t ? a.t < b.t : !a.in && b.in;
    });
    std::sort(segments_.begin(), segments_.begin() + static_cast<std::ptrdiff_t>(size_),
              [](const Segment& a, const Segment& b) {
                return a.t_in != b.t_in ? a.t_in < b.t_in : a.t_out < b.t_out;
              });
    if (std::isfinite(ray.t_max) || !turns(boundaries, ray.t_min, last, gaps, differ) ||
        !segments_fit(boundaries, gaps))
      decline();
  }

 private:
  struct Boundary {
    double t;
    float scalar;
    bool in;
  };

  template <class Differ>
  bool turns(std::span<const Boundary> boundaries, double t_min, double last, const Gaps& gaps,
             const Differ& differ) {
    entries_ = 0;
    for (std::size_t i = 0; i < boundaries.size(); ++i) {
      const Boundary& here = boundaries[i];
      if (here.t > last) break;
      if (here.in != (i % 2 == 0)) return false;
      if (i == 0 && !(here.t >= t_min)) return false;
      if (!here.in) continue;
      ++entries_;
      if (i == 0) continue;
      const Boundary& before = boundaries[i - 1];
      if (here.t - before.t <= gaps.connected && differ(before.scalar, here.scalar)) return false;
    }
    return true;
  }

  bool segments_fit(std::span<const Boundary> boundaries, const Gaps& gaps) const {
    for (std::size_t s = 0; s < size_; ++s) {
      const Segment& segment = segments_[s];
      if (s > 0 && !(segment.t_in >= segments_[s - 1].t_out)) return false;
      int inside = 0;
      for (std::size_t i = 0; i < boundaries.size() && boundaries[i].t <= segment.t_in; ++i) {
        inside += boundaries[i].in ? 1 : -1;
        if (!boundaries[i].in && segment.t_in - boundaries[i].t <= gaps.rounding) return false;
      }
      if (inside != 1) return false;
    }
    return true;
  }

  std::array<Segment, kMostSegments> segments_;
  std::array<Boundary, kMostBoundaries> crossings_;
  std::size_t size_ = 0, boundaries_ = 0, entries_ = 0, cells_ = 0;
  bool declined_ = false;
};

}  // namespace plume
