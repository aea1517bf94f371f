/// What was found of a ray without walking along it, and whether it is what a walk would have met.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "plume/traverse/ray.h"
#include "plume/traverse/segment.h"

namespace plume {

/// A crossing of a cell's face, as the cell's form numbers them.
struct FaceCrossing {
  std::uint32_t face = 0, rank = 0;
};

/// A segment that was found.
struct FoundSegment : Segment {
  double z_in = 0, z_out = 0;  ///< places of the ends in the sheared frame
  double opacity = -1;         ///< see SoughtSegments; -1 where that was not asked
  FaceCrossing in, out;        ///< by which it comes into the cell, and leaves it
  bool is_clear = false;       ///< nothing on the way to the cell can be behind where it comes in
  bool follows = false;        ///< on the segment before it, with nothing between them
};

/// Segments that matter, and the places where the ray crosses the boundary up to the last of them.
/// They come in any order; finish() sorts them and checks them. A ray that fails, or that crosses
/// the boundary too often for the list, is declined: it must be walked.
class SearchedRay {
 public:
  static constexpr std::size_t kMostBoundaries = 12;

  void clear() {
    segments_.clear();
    faces_met_ = boundaries_ = cells_ = 0;
    declined_ = false;
  }
  void decline() { declined_ = true; }
  bool declined() const { return declined_; }

  /// A cell was looked at.
  void count() { ++cells_; }
  void add(const FoundSegment& segment) { segments_.push_back(segment); }
  /// The ray comes in (or goes out) through the boundary at t, where the scalar is that.
  void cross_boundary(double t, float scalar, bool in) {
    if (boundaries_ == kMostBoundaries) return decline();
    crossings_[boundaries_++] = {t, scalar, in};
  }

  /// The same of a face that the ray crosses once: where, is left for later.
  void meet_boundary(std::uint32_t face) {
    if (faces_met_ == kMostBoundaries) return decline();
    faces_[faces_met_++] = face;
  }
  std::span<const std::uint32_t> boundary_faces() const { return {faces_.data(), faces_met_}; }
  /// Whether the ray meets no segment and two faces at the boundary. It has then come in once.
  bool passes_once() {
    if (declined_ || !segments_.empty() || faces_met_ != 2) return false;
    entries_ = 1;
    return true;
  }

  /// Drops the segments behind those, the nearest ones, that together let no more than that through
  /// of what lies behind; returns how much they do. Sorts.
  double drop_hidden(double least_transmittance) {
    sort_segments();
    double transmittance = 1;
    std::size_t kept = 0;
    while (kept < segments_.size() && transmittance > least_transmittance)
      transmittance *= 1 - segments_[kept++].opacity;
    segments_.resize(kept);
    return transmittance;
  }

  /// Front to back after finish().
  std::span<const FoundSegment> segments() const { return segments_; }
  std::span<FoundSegment> segments() { return segments_; }
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
    std::sort(crossings_.begin(), crossings_.begin() + static_cast<std::ptrdiff_t>(boundaries_),
              [](const Boundary& a, const Boundary& b) {
                return a.t != b.t ? a.t < b.t : !a.in && b.in;
              });
    sort_segments();
    if (std::isfinite(ray.t_max) || !turns(ray.t_min, last, gaps, differ) || !segments_fit(gaps))
      decline();
  }

 private:
  struct Boundary {
    double t;
    float scalar;
    bool in;
  };

  template <class Differ>
  bool turns(double t_min, double last, const Gaps& gaps, const Differ& differ) {
    entries_ = 0;
    for (std::size_t i = 0; i < boundaries_; ++i) {
      const Boundary& here = crossings_[i];
      if (here.t > last) break;
      if (here.in != (i % 2 == 0)) return false;
      if (i == 0 && !(here.t >= t_min)) return false;
      if (!here.in) continue;
      ++entries_;
      if (i == 0) continue;
      const Boundary& before = crossings_[i - 1];
      if (here.t - before.t <= gaps.connected && differ(before.scalar, here.scalar)) return false;
    }
    return true;
  }

  bool segments_fit(const Gaps& gaps) const {
    std::size_t passed = 0;  // crossings of the boundary
    for (std::size_t s = 0; s < segments_.size(); ++s) {
      const double t_in = segments_[s].t_in;
      if (s > 0 && !(t_in >= segments_[s - 1].t_out)) return false;
      while (passed < boundaries_ && crossings_[passed].t <= t_in) ++passed;
      // In and out, in turns.
      if (passed % 2 == 0) return false;
      if (passed > 1 && t_in - crossings_[passed - 2].t <= gaps.rounding) return false;
    }
    return true;
  }

  void sort_segments() {
    auto before = [](const Segment& a, const Segment& b) {
      return a.t_in != b.t_in ? a.t_in < b.t_in : a.t_out < b.t_out;
    };
    if (!std::is_sorted(segments_.begin(), segments_.end(), before))
      std::sort(segments_.begin(), segments_.end(), before);
  }

  std::vector<FoundSegment> segments_;
  std::array<std::uint32_t, kMostBoundaries> faces_;
  std::array<Boundary, kMostBoundaries> crossings_;
  std::size_t faces_met_ = 0, boundaries_ = 0, entries_ = 0, cells_ = 0;
  bool declined_ = false;
};

}  // namespace plume
