#include "plume/lib/mode_packets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/lib/cell_curved_mode_packets.cpp"
#include "hwy/foreach_target.h"
#include "plume/lib/curved_mode_consumers-inl.h"
#include "plume/traverse/cell_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void ReduceCurvedCell(const WalkableCells& mesh, const ModePackets& packets, int axis,
                      PacketFeeder& feeder) {
  ReduceCurved(mesh, packets, axis, feeder);
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(ReduceCurvedCell);

void reduce_curved_packets(const WalkableCells& mesh, const ModePackets& packets, int axis,
                           PacketFeeder& feeder) {
  HWY_DYNAMIC_DISPATCH(ReduceCurvedCell)(mesh, packets, axis, feeder);
}

}  // namespace plume
#endif  // HWY_ONCE
