#include "plume/lib/volume_packets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/lib/tet_volume_packets.cpp"
#include "hwy/foreach_target.h"
#include "plume/lib/composite_by-inl.h"
#include "plume/traverse/tet_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void CompositeTetVolume(const WalkableTets& mesh, const PacketOptics& optics, int axis,
                        PacketFeeder& feeder) {
  CompositeVolume(optics, mesh.cell_values,
                  [&](auto& consumer) { Walk(mesh, axis, consumer, feeder); });
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(CompositeTetVolume);

void composite_packets(const WalkableTets& mesh, const PacketOptics& optics, int axis,
                       PacketFeeder& feeder) {
  if (optics.classified != nullptr)
    composite_classified(mesh, optics, axis, feeder);
  else
    HWY_DYNAMIC_DISPATCH(CompositeTetVolume)(mesh, optics, axis, feeder);
}

}  // namespace plume
#endif  // HWY_ONCE
