/// What the parts of a classified ray look like.
#pragma once

#include <vector>

#include "plume/preint/classification.h"
#include "plume/preint/interval_optics.h"
#include "plume/preint/interval_state.h"
#include "plume/preint/scalar_ranges.h"
#include "plume/preint/segment_optics.h"

namespace plume {

/// A classification made ready for rays. Immutable; safe to share between threads.
class ClassifiedOptics {
 public:
  /// Requires !classification.problem().
  explicit ClassifiedOptics(const Classification& classification,
                            IntervalForm form = IntervalForm::exponential);

  const ScalarRanges& ranges() const { return ranges_; }
  bool has_volume() const { return has_volume_; }

  /// What a part adds, of a piece of that length in world units. `volume` integrates the
  /// classification's volume; where there is none, it is not asked. Error: that of `volume`, of
  /// IntervalOptics, and none.
  template <SegmentIntegrator Volume>
  SegmentColor color(const ClassifiedPart& part, double length, const Volume& volume) const {
    switch (part.kind) {
      case ClassifiedPart::Kind::volume:
        break;
      case ClassifiedPart::Kind::interval:
        return intervals_[static_cast<std::size_t>(part.index)].integrate(part.from, part.to);
      case ClassifiedPart::Kind::surface:
        return surfaces_[static_cast<std::size_t>(part.index)];
    }
    return has_volume_ ? volume.integrate(part.from, part.to, length_of(part, length))
                       : SegmentColor{};
  }

  /// The optical depth of a part; infinite for an opaque surface.
  template <SegmentIntegrator Volume>
  float optical_depth(const ClassifiedPart& part, double length, const Volume& volume) const {
    switch (part.kind) {
      case ClassifiedPart::Kind::volume:
        break;
      case ClassifiedPart::Kind::interval:
        return intervals_[static_cast<std::size_t>(part.index)].optical_depth(part.from, part.to);
      case ClassifiedPart::Kind::surface:
        return -std::log1p(-surfaces_[static_cast<std::size_t>(part.index)].alpha);
    }
    return has_volume_ ? volume.optical_depth(part.from, part.to, length_of(part, length)) : 0;
  }

 private:
  static float length_of(const ClassifiedPart& part, double length) {
    return static_cast<float>((part.share_to - part.share_from) * length);
  }

  ScalarRanges ranges_;
  bool has_volume_;
  std::vector<IntervalOptics> intervals_;
  std::vector<SegmentColor> surfaces_;
};

}  // namespace plume
