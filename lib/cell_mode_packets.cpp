#include "plume/lib/mode_packets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/lib/cell_mode_packets.cpp"
#include "hwy/foreach_target.h"
#include "plume/lib/mode_consumers-inl.h"
#include "plume/traverse/cell_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void ReduceCell(const WalkableCells& mesh, const ModePackets& packets, int axis,
                PacketFeeder& feeder) {
  ReduceBy<true>(packets, mesh.cell_values,
                 [&](auto& consumer) { Walk(mesh, axis, consumer, feeder); });
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(ReduceCell);

void reduce_packets(const WalkableCells& mesh, const ModePackets& packets, int axis,
                    PacketFeeder& feeder) {
  HWY_DYNAMIC_DISPATCH(ReduceCell)(mesh, packets, axis, feeder);
}

}  // namespace plume
#endif  // HWY_ONCE
