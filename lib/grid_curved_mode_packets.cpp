#include "plume/lib/mode_packets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/lib/grid_curved_mode_packets.cpp"
#include "hwy/foreach_target.h"
#include "plume/lib/curved_mode_consumers-inl.h"
#include "plume/traverse/grid_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void ReduceCurvedGrid(const WalkableGrid& mesh, const ModePackets& packets, int axis,
                      PacketFeeder& feeder) {
  ReduceCurved(mesh, packets, axis, feeder);
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(ReduceCurvedGrid);

void reduce_curved_packets(const WalkableGrid& mesh, const ModePackets& packets, int axis,
                           PacketFeeder& feeder) {
  HWY_DYNAMIC_DISPATCH(ReduceCurvedGrid)(mesh, packets, axis, feeder);
}

}  // namespace plume
#endif  // HWY_ONCE
