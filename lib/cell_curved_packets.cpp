#include "plume/lib/curved_packets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/lib/cell_curved_packets.cpp"
#include "hwy/foreach_target.h"
#include "plume/lib/curved_consumer-inl.h"
#include "plume/traverse/cell_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void CompositeCurvedCell(const WalkableCells& mesh, const CurvedPackets& packets, int axis,
                         PacketFeeder& feeder) {
  CompositeCurved(mesh, packets, axis, feeder);
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(CompositeCurvedCell);

void composite_curved_packets(const WalkableCells& mesh, const CurvedPackets& packets, int axis,
                              PacketFeeder& feeder) {
  HWY_DYNAMIC_DISPATCH(CompositeCurvedCell)(mesh, packets, axis, feeder);
}

}  // namespace plume
#endif  // HWY_ONCE
