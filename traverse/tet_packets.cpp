#include "plume/traverse/packets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/traverse/tet_packets.cpp"
#include "hwy/foreach_target.h"
#include "plume/traverse/packet_consumers-inl.h"
#include "plume/traverse/tet_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void TetCountCells(const WalkableTets& mesh, int axis, PacketFeeder& feeder,
                   std::span<std::uint32_t> counts) {
  CountConsumer consumer{counts};
  Walk(mesh, axis, consumer, feeder);
}

void TetIntegrateScalar(const WalkableTets& mesh, int axis, PacketFeeder& feeder,
                        std::span<PacketIntegral> sums) {
  IntegralConsumer consumer{sums};
  Walk(mesh, axis, consumer, feeder);
}

void TetFindIsosurface(const WalkableTets& mesh, int axis, float isovalue, PacketFeeder& feeder,
                       std::span<PacketHit> hits) {
  IsosurfaceConsumer consumer{isovalue, hits};
  Walk(mesh, axis, consumer, feeder);
}

void TetWalkSegments(const WalkableTets& mesh, int axis, PacketFeeder& feeder,
                     PacketSegmentSink& sink) {
  SegmentConsumer consumer{sink};
  Walk(mesh, axis, consumer, feeder);
}

const char* InstructionSet() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(TetCountCells);
HWY_EXPORT(TetIntegrateScalar);
HWY_EXPORT(TetFindIsosurface);
HWY_EXPORT(TetWalkSegments);
HWY_EXPORT(InstructionSet);

void count_cells(const WalkableTets& mesh, int axis, PacketFeeder& feeder,
                 std::span<std::uint32_t> counts) {
  HWY_DYNAMIC_DISPATCH(TetCountCells)(mesh, axis, feeder, counts);
}

void integrate_scalar(const WalkableTets& mesh, int axis, PacketFeeder& feeder,
                      std::span<PacketIntegral> sums) {
  HWY_DYNAMIC_DISPATCH(TetIntegrateScalar)(mesh, axis, feeder, sums);
}

void find_isosurface(const WalkableTets& mesh, int axis, float isovalue, PacketFeeder& feeder,
                     std::span<PacketHit> hits) {
  HWY_DYNAMIC_DISPATCH(TetFindIsosurface)(mesh, axis, isovalue, feeder, hits);
}

void walk_segments(const WalkableTets& mesh, int axis, PacketFeeder& feeder,
                   PacketSegmentSink& sink) {
  HWY_DYNAMIC_DISPATCH(TetWalkSegments)(mesh, axis, feeder, sink);
}

const char* packet_instruction_set() { return HWY_DYNAMIC_DISPATCH(InstructionSet)(); }

void limit_packet_instruction_sets(std::int64_t targets) {
  hwy::SetSupportedTargetsForTest(targets);
}

}  // namespace plume
#endif  // HWY_ONCE
