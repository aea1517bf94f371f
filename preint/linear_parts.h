/// A classification as media whose optics are linear along parts of a ray.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "plume/preint/classification.h"
#include "plume/preint/interval_optics.h"
#include "plume/preint/interval_state.h"
#include "plume/preint/optical_depth.h"
#include "plume/preint/optics_sum.h"
#include "plume/preint/pieces.h"
#include "plume/preint/scalar_ranges.h"

namespace plume {

/// What ClassifiedOptics is where a ray meets one thing after the other, for rays that may meet
/// several at once: a part of the volume or of an interval is cut at the knots, between which its
/// extinction and colour are linear over the distance; of an interval, extinction per unit of w
/// becomes one per unit of length. The exponential form of intervals alone can be mixed so.
/// Immutable; safe to share between threads.
class LinearParts {
 public:
  /// Requires !classification.problem().
  explicit LinearParts(const Classification& classification);

  const ScalarRanges& ranges() const { return ranges_; }

  /// Whether a part of that length has no thickness and is to be seen: an isosurface, an interval
  /// in a jump or one that is cut.
  static bool is_thin(const ClassifiedPart& part, double length) {
    return part.kind == ClassifiedPart::Kind::surface ||
           (part.kind == ClassifiedPart::Kind::interval && !(length > 0));
  }

  /// What a thin part adds.
  PreciseColor thin(const ClassifiedPart& part) const;

  /// The optical depth of a part of the volume, of that length in world units.
  double volume_depth(const ClassifiedPart& part, double length) const {
    return volume_ ? volume_->mean_extinction(part.from, part.to) * length : 0;
  }
  /// The opacity of an isosurface.
  double surface_alpha(const ClassifiedPart& part) const {
    return surfaces_[static_cast<std::size_t>(part.index)].alpha;
  }

  /// Calls visit(const LinearOptics&, double from, double to) for each piece of a part that is not
  /// thin, in turn; `length` is that of the part, in world units, from and to are shares of it.
  template <class Visit>
  void for_each_piece(const ClassifiedPart& part, double length, Visit&& visit) const {
    const bool is_volume = part.kind == ClassifiedPart::Kind::volume;
    if (!(length > 0) || (is_volume && !volume_)) return;
    const Pieces& pieces =
        is_volume ? volume_->pieces() : profiles_[static_cast<std::size_t>(part.index)];
    const double per_length =
        is_volume ? 1 : std::abs(static_cast<double>(part.to) - part.from) / length;
    double from = 0;
    pieces.walk(part.from, part.to, [&](PreciseOptics front, PreciseOptics back, double fraction) {
      if (!(fraction > 0)) return true;
      front.extinction *= per_length;
      back.extinction *= per_length;
      const double to = std::fmin(from + fraction, 1.0);
      visit(LinearOptics{front, back}, from, to);
      from = to;
      return true;
    });
  }

 private:
  ScalarRanges ranges_;
  std::optional<OpticalDepth> volume_;
  std::vector<Pieces> profiles_;
  std::vector<IntervalOptics> intervals_;
  std::vector<PreciseColor> surfaces_;
};

}  // namespace plume
