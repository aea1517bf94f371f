#include "plume/lib/mode_packets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/lib/rectilinear_mode_packets.cpp"
#include "hwy/foreach_target.h"
#include "plume/lib/mode_consumers-inl.h"
#include "plume/traverse/rectilinear_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void ReduceRectilinear(const WalkableRectilinear& mesh, const ModePackets& packets,
                       PacketFeeder& feeder) {
  ReduceBy<true>(packets, mesh.cell_values, [&](auto& consumer) { Walk(mesh, consumer, feeder); });
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(ReduceRectilinear);

void reduce_packets(const WalkableRectilinear& mesh, const ModePackets& packets,
                    PacketFeeder& feeder) {
  HWY_DYNAMIC_DISPATCH(ReduceRectilinear)(mesh, packets, feeder);
}

}  // namespace plume
#endif  // HWY_ONCE
