/// The scalar axis cut at the ends of intervals and at isovalues.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "plume/preint/classification.h"

namespace plume {

/// Ranges between ascending bounds; range k lies between bound k - 1 and bound k, and every scalar
/// is in exactly one. An integral split here is split in data space, exactly (Ament, Weiskopf and
/// Carr 2010, section 4): no table interpolates across a bound.
///
/// A value that equals a bound is above it, but for the upper end of an interval that no other
/// interval touches: it still belongs to the interval, which is closed at both ends. So a region
/// where the field is constant at an isovalue is above the isosurface, and one where it is constant
/// at an end of an interval is inside of it.
class ScalarRanges {
 public:
  static constexpr std::int32_t kNothing = -1;

  struct Bound {
    float scalar;
    /// Whether an equal value is still below.
    bool equal_is_below;
    /// The isosurface at this bound, or kNothing.
    std::int32_t isosurface = kNothing;
  };

  /// Requires !classification.problem().
  explicit ScalarRanges(const Classification& classification);

  /// The range in which a finite scalar lies: the number of bounds below it.
  std::size_t range_of(float scalar) const;

  const Bound& bound(std::size_t index) const { return bounds_[index]; }
  std::size_t bound_count() const { return bounds_.size(); }

  /// The interval that a range is a part of, or kNothing: the volume's.
  std::int32_t interval_of(std::size_t range) const { return interval_of_range_[range]; }

  float low(std::int32_t interval) const { return ends_[static_cast<std::size_t>(interval)].low; }
  float high(std::int32_t interval) const { return ends_[static_cast<std::size_t>(interval)].high; }

  /// w of a scalar of the interval, in [0, 1]; exactly 0 and 1 at its ends.
  float w_of(std::int32_t interval, float scalar) const;

  /// The scalar of a w of the interval; exactly its ends at 0 and 1.
  float scalar_of(std::int32_t interval, float w) const;

 private:
  struct Ends {
    float low, high;
  };
  std::vector<Bound> bounds_;
  std::vector<std::int32_t> interval_of_range_;
  std::vector<Ends> ends_;
};

}  // namespace plume
