/// What a ray carries from segment to segment through interval volumes and isosurfaces.
#pragma once

#include <cmath>
#include <cstdint>

#include "plume/preint/scalar_ranges.h"

namespace plume {

/// A part of a linear piece of a ray that one thing is to be seen in.
struct ClassifiedPart {
  enum class Kind : std::uint8_t { volume, interval, surface };
  Kind kind;
  /// Of the interval or of the isosurface in the Classification; 0 for the volume.
  std::int32_t index = 0;
  /// Volume: the scalar where the part begins and ends. Interval: w, from what was covered last to
  /// what is covered now. Surface: its value, twice.
  float from = 0, to = 0;
  /// Where the part begins and ends, as shares of the piece; equal for a surface.
  double share_from = 0, share_to = 0;
  /// Surface: whether the scalar rises. Interval: whether w does.
  bool rising = true;
  /// Interval: the first part of a visit, which begins where the ray came in.
  bool first_of_visit = false;
  /// Interval: the ray began inside of it, and the part is the whole interval.
  bool clipped = false;
};

/// Splits a ray's linear pieces, in the order in which it meets them, at the bounds of
/// ScalarRanges, and leaves out of interval volumes what was seen before.
///
/// Monotone traversal: of one connected visit to an interval only the part of [0, 1] counts that
/// lies beyond the extreme reached so far, seen from the end by which the ray came in. So opacity
/// depends on neither space nor the number of cells: crossed, all of [0, 1]; left by the end by
/// which the ray came in, [0, w] of the deepest w (or [w, 1]). Source: Ament, Weiskopf and Carr
/// 2010, equations 14 to 17 and algorithm 2.
///
/// A ray that begins inside (strictly between the ends) sees the whole interval there, from w = 0
/// to 1, and nothing more of that visit, so that the faces of a cut look even (section 6.4). One
/// that begins at an end has come in there. One that ends inside sees what it has reached.
///
/// An isosurface is crossed where the scalar goes from below its value to at least its value, or
/// back (see ScalarRanges): a property of the two scalars alone, so that a ray through a vertex of
/// that value, or one through cells that are constant at it, crosses once or not at all, as its
/// ends say. A ray that only touches the value from below crosses twice, in and out; from above,
/// not at all. A ray that begins at the value is above.
///
/// Where a piece does not begin with the scalar at which the last one ended (between cells that are
/// constant), the jump counts as a piece of no length: it crosses all that lies between.
class IntervalState {
 public:
  /// Keeps a reference.
  explicit IntervalState(const ScalarRanges& ranges) : ranges_(&ranges) {}

  /// The ray leaves the mesh, or what is known of it: the next piece begins a new passage.
  void reset() { inside_ = false; }

  /// A piece along which the scalar runs linearly from s_in to s_out; calls
  ///     visit(const ClassifiedPart&)
  /// for each part, front to back, until it returns false, after which the state means nothing.
  /// Returns whether all were visited. A piece with an end that is NaN or infinite has no parts,
  /// and resets.
  template <class Visit>
  bool add(float s_in, float s_out, Visit&& visit) {
    if (!std::isfinite(s_in) || !std::isfinite(s_out)) {
      reset();
      return true;
    }
    if (!inside_) {
      if (!begin(s_in, visit)) return false;
    } else if (s_in != last_ && !run(last_, s_in, 0, visit)) {
      return false;
    }
    last_ = s_out;
    return run(s_in, s_out, 1, visit);
  }

 private:
  template <class Visit>
  bool begin(float scalar, Visit&& visit) {
    inside_ = true;
    range_ = ranges_->range_of(scalar);
    const std::int32_t interval = ranges_->interval_of(range_);
    if (interval == ScalarRanges::kNothing) return true;
    const bool at_low = scalar == ranges_->low(interval);
    if (at_low || scalar == ranges_->high(interval)) {
      enter(at_low);
      return true;
    }
    rising_ = true;
    reached_ = 1;
    return visit(
        ClassifiedPart{ClassifiedPart::Kind::interval, interval, 0, 1, 0, 0, true, true, true});
  }

  void enter(bool rising) {
    rising_ = rising;
    reached_ = rising ? 0.0f : 1.0f;
  }

  // From one scalar to another over `length`, a share of the piece: 1, or 0 for a jump.
  template <class Visit>
  bool run(float s_in, float s_out, double length, Visit&& visit) {
    const std::size_t last_range = ranges_->range_of(s_out);
    const double per_scalar = length / (static_cast<double>(s_out) - s_in);
    float scalar = s_in;
    double share = 0;
    while (range_ != last_range) {
      const bool rising = last_range > range_;
      const ScalarRanges::Bound& bound = ranges_->bound(rising ? range_ : range_ - 1);
      const double place = (static_cast<double>(bound.scalar) - s_in) * per_scalar;
      if (!within_range(scalar, bound.scalar, share, place, visit)) return false;
      scalar = bound.scalar;
      share = place;
      if (bound.isosurface != ScalarRanges::kNothing &&
          !visit(ClassifiedPart{ClassifiedPart::Kind::surface, bound.isosurface, scalar, scalar,
                                share, share, rising}))
        return false;
      const std::int32_t left = ranges_->interval_of(range_);
      range_ = rising ? range_ + 1 : range_ - 1;
      const std::int32_t entered = ranges_->interval_of(range_);
      if (entered != left && entered != ScalarRanges::kNothing) enter(rising);
    }
    return within_range(scalar, s_out, share, length, visit);
  }

  template <class Visit>
  bool within_range(float from, float to, double share_from, double share_to, Visit&& visit) {
    const std::int32_t interval = ranges_->interval_of(range_);
    if (interval == ScalarRanges::kNothing)
      return !(share_to > share_from) ||
             visit(ClassifiedPart{ClassifiedPart::Kind::volume, 0, from, to, share_from, share_to,
                                  to >= from});
    const float w_from = ranges_->w_of(interval, from), w_to = ranges_->w_of(interval, to);
    if (rising_ ? w_to <= reached_ : w_to >= reached_) return true;
    const double known = (static_cast<double>(reached_) - w_from) /
                         (static_cast<double>(w_to) - static_cast<double>(w_from));
    const ClassifiedPart part{ClassifiedPart::Kind::interval,
                              interval,
                              reached_,
                              w_to,
                              share_from + known * (share_to - share_from),
                              share_to,
                              rising_,
                              reached_ == (rising_ ? 0.0f : 1.0f)};
    reached_ = w_to;
    return visit(part);
  }

  const ScalarRanges* ranges_;
  bool inside_ = false;
  // Where the ray is: its last scalar and the range of that.
  float last_ = 0;
  std::size_t range_ = 0;
  // Of the visit, where the range is an interval's: whether the ray came in by the low end, and the
  // extreme of w since.
  bool rising_ = true;
  float reached_ = 0;
};

}  // namespace plume
