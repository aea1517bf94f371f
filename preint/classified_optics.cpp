#include "plume/preint/classified_optics.h"

namespace plume {

ClassifiedOptics::ClassifiedOptics(const Classification& classification, IntervalForm form)
    : ranges_(classification), has_volume_(classification.volume.has_value()) {
  for (const IntervalVolume& interval : classification.intervals)
    intervals_.emplace_back(interval.profile, form);
  for (const Isosurface& surface : classification.isosurfaces)
    surfaces_.push_back({surface.opacity * surface.color[0], surface.opacity * surface.color[1],
                         surface.opacity * surface.color[2], surface.opacity});
}

}  // namespace plume
