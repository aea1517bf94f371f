// Compositing by the consumer that fits what there is to composite. Compiled once for each
// instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_LIB_COMPOSITE_BY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_LIB_COMPOSITE_BY_INL_H_
#undef PLUME_LIB_COMPOSITE_BY_INL_H_
#else
#define PLUME_LIB_COMPOSITE_BY_INL_H_
#endif
// clang-format on

#include <algorithm>
#include <type_traits>
#include <vector>

#include "hwy/highway.h"
#include "plume/lib/classified_consumer-inl.h"
#include "plume/lib/piece_tables-inl.h"
#include "plume/lib/volume_consumer-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// Composites by walk(consumer).
template <class Walk>
void CompositeBy(const PacketOptics& optics, const std::vector<float>& cell_values,
                 const Walk& walk) {
  const float* const values = cell_values.empty() ? nullptr : cell_values.data();
  // Behind a transmittance of 1e-9 nothing changes a float between 0 and 1.
  const float enough = std::max(optics.early_termination, optics::kInvisible);
  if (optics.classified != nullptr)
    return WithTable(optics.classified->pieces.pieces, [&](const auto& table) {
      ClassifiedConsumer<std::decay_t<decltype(table)>> consumer{*optics.classified, table, values,
                                                                 enough, optics.colors};
      walk(consumer);
      consumer.count();
    });
  WithTable(optics.volume->pieces, [&](const auto& table) {
    VolumeConsumer<std::decay_t<decltype(table)>> consumer{*optics.volume, table, values, enough,
                                                           optics.colors};
    walk(consumer);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
