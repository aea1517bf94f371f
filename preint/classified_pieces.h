/// A classification cut into pieces of the scalar axis, in single precision, for packets of rays.
#pragma once

#include <cstddef>
#include <vector>

#include "plume/preint/classification.h"
#include "plume/preint/scalar_ranges.h"
#include "plume/preint/segment_optics.h"

namespace plume {

/// Pieces ascend and cover all finite scalars: those between the bounds of ScalarRanges, cut
/// further at the knots of the volume or of the interval's profile; and between two of them, where
/// there is an isosurface, a piece of no width for it.
///
/// With r = scalar - low, extinction is extinction + r * extinction_slope, and each colour
/// likewise: per unit of length in the volume, per unit of w in an interval, whose `w_per_scalar`
/// leads from the one to the other. Where the ends of pieces are and which piece has them are two
/// questions: a scalar s lies in a piece if first <= s < end, whereas low and high are the bounds
/// themselves. They differ, by one float, above an interval whose upper end belongs to it.
struct ClassifiedPieces {
  /// Four times four floats, so that a lane's is fetched with four loads.
  struct Piece {
    float low, high, extinction, extinction_slope;  ///< of an isosurface, its opacity and 0
    float first, end, w_per_scalar, kind;
    float color[3], unused;
    float color_slope[3], unused_too;
  };
  /// `kind` of the volume's pieces and of isosurfaces; k + 1 of the interval k's. w_per_scalar is
  /// positive in intervals and 0 elsewhere.
  static constexpr float kVolume = 0, kSurface = -1;

  /// Requires !classification.problem().
  explicit ClassifiedPieces(const Classification& classification);

  /// Where a finite scalar lies, as ScalarRanges::range_of() has it.
  std::size_t piece_of(float scalar) const;

  /// False where an interval is so narrow, or so far from 0 for its width, that its pieces are not
  /// to be had in single precision.
  bool in_single_precision() const { return in_single_precision_; }

  std::vector<Piece> pieces;
  /// Of each interval, all of it, as a ray sees it that begins inside.
  std::vector<SegmentColor> whole_intervals;
  /// Of each interval.
  struct Ends {
    float low, high;
  };
  std::vector<Ends> ends;

 private:
  class Maker;
  bool in_single_precision_ = true;
};

}  // namespace plume
