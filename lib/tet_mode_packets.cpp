#include "plume/lib/mode_packets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/lib/tet_mode_packets.cpp"
#include "hwy/foreach_target.h"
#include "plume/lib/mode_consumers-inl.h"
#include "plume/traverse/tet_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// Walk() of tetrahedra has copies for meshes larger than the caches, which ask ahead, and for
// compact ones: the first are some 10% faster, the others are left to the scalar walker
// (has_mode_packets()). With them this file would compile three times as long, which is minutes.
template <class Consumer>
void WalkInTurn(const WalkableTets& mesh, int axis, Consumer& consumer, PacketFeeder& feeder) {
  WithAxis(axis, [&]<int kAxis>() {
    using Steps = TetSteps<kAxis, TetReads::cached>;
    PacketWalk<Steps, kPackets, false, Consumer>(Steps(mesh), consumer, feeder).run();
  });
}

void ReduceTet(const WalkableTets& mesh, const ModePackets& packets, int axis,
               PacketFeeder& feeder) {
  ReduceBy<true>(packets, mesh.cell_values,
                 [&](auto& consumer) { WalkInTurn(mesh, axis, consumer, feeder); });
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(ReduceTet);

void reduce_packets(const WalkableTets& mesh, const ModePackets& packets, int axis,
                    PacketFeeder& feeder) {
  HWY_DYNAMIC_DISPATCH(ReduceTet)(mesh, packets, axis, feeder);
}

}  // namespace plume
#endif  // HWY_ONCE
