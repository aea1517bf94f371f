#include "plume/traverse/packets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/traverse/rectilinear_packets.cpp"
#include "hwy/foreach_target.h"
#include "plume/traverse/packet_consumers-inl.h"
#include "plume/traverse/rectilinear_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void RectilinearCountCells(const WalkableRectilinear& mesh, PacketFeeder& feeder,
                           std::span<std::uint32_t> counts) {
  CountConsumer consumer{counts};
  Walk(mesh, consumer, feeder);
}

void RectilinearIntegrateScalar(const WalkableRectilinear& mesh, PacketFeeder& feeder,
                                std::span<PacketIntegral> sums) {
  IntegralConsumer consumer{sums};
  Walk(mesh, consumer, feeder);
}

void RectilinearFindIsosurface(const WalkableRectilinear& mesh, float isovalue,
                               PacketFeeder& feeder, std::span<PacketHit> hits) {
  IsosurfaceConsumer consumer{isovalue, hits};
  Walk(mesh, consumer, feeder);
}

void RectilinearWalkSegments(const WalkableRectilinear& mesh, PacketFeeder& feeder,
                             PacketSegmentSink& sink) {
  SegmentConsumer consumer{sink};
  Walk(mesh, consumer, feeder);
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(RectilinearCountCells);
HWY_EXPORT(RectilinearIntegrateScalar);
HWY_EXPORT(RectilinearFindIsosurface);
HWY_EXPORT(RectilinearWalkSegments);

void count_cells(const WalkableRectilinear& mesh, PacketFeeder& feeder,
                 std::span<std::uint32_t> counts) {
  HWY_DYNAMIC_DISPATCH(RectilinearCountCells)(mesh, feeder, counts);
}

void integrate_scalar(const WalkableRectilinear& mesh, PacketFeeder& feeder,
                      std::span<PacketIntegral> sums) {
  HWY_DYNAMIC_DISPATCH(RectilinearIntegrateScalar)(mesh, feeder, sums);
}

void find_isosurface(const WalkableRectilinear& mesh, float isovalue, PacketFeeder& feeder,
                     std::span<PacketHit> hits) {
  HWY_DYNAMIC_DISPATCH(RectilinearFindIsosurface)(mesh, isovalue, feeder, hits);
}

void walk_segments(const WalkableRectilinear& mesh, PacketFeeder& feeder, PacketSegmentSink& sink) {
  HWY_DYNAMIC_DISPATCH(RectilinearWalkSegments)(mesh, feeder, sink);
}

}  // namespace plume
#endif  // HWY_ONCE
