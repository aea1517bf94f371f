#include "plume/lib/volume_packets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/lib/tet_classified_packets.cpp"
#include "hwy/foreach_target.h"
#include "plume/lib/composite_by-inl.h"
#include "plume/traverse/tet_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void CompositeTetClassified(const WalkableTets& mesh, const PacketOptics& optics, int axis,
                            PacketFeeder& feeder) {
  CompositeClassified(optics, mesh.cell_values,
                      [&](auto& consumer) { Walk(mesh, axis, consumer, feeder); });
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(CompositeTetClassified);

void composite_classified(const WalkableTets& mesh, const PacketOptics& optics, int axis,
                          PacketFeeder& feeder) {
  HWY_DYNAMIC_DISPATCH(CompositeTetClassified)(mesh, optics, axis, feeder);
}

}  // namespace plume
#endif  // HWY_ONCE
