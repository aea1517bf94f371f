#include "plume/preint/linear_parts.h"

namespace plume {

LinearParts::LinearParts(const Classification& classification) : ranges_(classification) {
  if (classification.volume) volume_.emplace(*classification.volume);
  for (const IntervalVolume& interval : classification.intervals) {
    profiles_.emplace_back(interval.profile);
    intervals_.emplace_back(interval.profile, IntervalForm::exponential);
  }
  for (const Isosurface& surface : classification.isosurfaces) {
    const double alpha = surface.opacity;
    surfaces_.push_back(
        {{alpha * surface.color[0], alpha * surface.color[1], alpha * surface.color[2]}, alpha});
  }
}

PreciseColor LinearParts::thin(const ClassifiedPart& part) const {
  if (part.kind == ClassifiedPart::Kind::surface)
    return surfaces_[static_cast<std::size_t>(part.index)];
  const SegmentColor color =
      intervals_[static_cast<std::size_t>(part.index)].integrate(part.from, part.to);
  return {{color.r, color.g, color.b}, color.alpha};
}

}  // namespace plume
