/// Volume, intervals and isosurfaces from tables, as in the paper: to compare with what is split in
/// data space.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "plume/preint/classified_optics.h"
#include "plume/preint/closed_form.h"
#include "plume/preint/interval_way.h"
#include "plume/preint/segment_optics.h"

namespace plume {

/// A table over both scalars of a segment says where it leaves one interval and enters another, and
/// one over scalars and length what all of it looks like: volume, the intervals that are covered
/// and the isosurfaces that are crossed. Source: Ament, Weiskopf and Carr 2010, sections 6.2
/// (algorithm 2, equation 27) and 6.3; here with the exponential form of opacity, which needs no
/// correction.
///
/// Error: none that is bounded. Whether a scalar lies in an interval is known to one entry, and
/// optical depths are interpolated across bounds: a ray that passes an isosurface sees it once, as
/// the parts add up, but one that turns back within an entry of it sees a part of it or too much.
/// An isosurface inside of an interval is not seen where the interval has been seen before.
/// Measured: docs/evidence.md.
class IntervalTable {
 public:
  /// Requires !classification.problem(), lowest < highest and 0 < shortest < longest. A shorter
  /// segment is taken for the shortest, a longer for the longest. Built on all threads of TBB: 16
  /// bytes an entry of scalar_count^2 length_count.
  IntervalTable(const Classification& classification, std::array<float, 2> scalar_range,
                std::array<float, 2> length_range, const IntervalTableSettings& settings = {});

  /// What a ray carries from segment to segment; made anew for each passage.
  struct State {
    bool inside = false;  ///< of the passage: it has begun
    int direction = 0;    ///< in which the interval is traversed; 0: in none, or seen whole
    std::int32_t interval = ScalarRanges::kNothing;
    float threshold = 0;  ///< the extreme so far
  };

  /// A segment along which the scalar is linear, and the next of its passage.
  SegmentColor add(State& state, float s_in, float s_out, float length) const;

  std::size_t bytes() const { return entries_.size() * sizeof(Entry); }

 private:
  /// Colour divided by opacity and weighted by the optical depth; then that.
  struct alignas(16) Entry {
    std::array<float, 4> values{0, 0, 0, 0};
  };

  SegmentColor whole_segment(float s_in, float s_out, double length) const;
  void fill();
  std::size_t nearest(float scalar) const;
  float scalar_of(std::size_t entry) const;
  SegmentColor look_up(float s_in, float s_out, float length) const;

  ScalarRanges ranges_;
  ClassifiedOptics optics_;
  ClosedForm volume_;
  std::size_t scalar_count_, length_count_;
  float lowest_, highest_, shortest_, longest_;
  double scalar_density_, length_density_;
  std::vector<std::int32_t> interval_of_entry_;
  std::vector<SegmentColor> whole_intervals_;
  std::vector<Entry> entries_;
};

}  // namespace plume
