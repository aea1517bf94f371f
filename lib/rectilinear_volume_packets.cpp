#include "plume/lib/volume_packets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/lib/rectilinear_volume_packets.cpp"
#include "hwy/foreach_target.h"
#include "plume/lib/composite_by-inl.h"
#include "plume/traverse/rectilinear_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void CompositeRectilinear(const WalkableRectilinear& mesh, const PacketOptics& optics,
                          PacketFeeder& feeder) {
  CompositeBy(optics, mesh.cell_values, [&](auto& consumer) { Walk(mesh, consumer, feeder); });
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(CompositeRectilinear);

void composite_packets(const WalkableRectilinear& mesh, const PacketOptics& optics,
                       PacketFeeder& feeder) {
  HWY_DYNAMIC_DISPATCH(CompositeRectilinear)(mesh, optics, feeder);
}

}  // namespace plume
#endif  // HWY_ONCE
