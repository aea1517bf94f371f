#include "plume/traverse/packets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/traverse/grid_packets.cpp"
#include "hwy/foreach_target.h"
#include "plume/traverse/grid_steps-inl.h"
#include "plume/traverse/packet_consumers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void GridCountCells(const WalkableGrid& mesh, int axis, PacketFeeder& feeder,
                    std::span<std::uint32_t> counts) {
  CountConsumer consumer{counts};
  Walk(mesh, axis, consumer, feeder);
}

void GridIntegrateScalar(const WalkableGrid& mesh, int axis, PacketFeeder& feeder,
                         std::span<PacketIntegral> sums) {
  IntegralConsumer consumer{sums};
  Walk(mesh, axis, consumer, feeder);
}

void GridFindIsosurface(const WalkableGrid& mesh, int axis, float isovalue, PacketFeeder& feeder,
                        std::span<PacketHit> hits) {
  IsosurfaceConsumer consumer{isovalue, hits};
  Walk(mesh, axis, consumer, feeder);
}

void GridWalkSegments(const WalkableGrid& mesh, int axis, PacketFeeder& feeder,
                      PacketSegmentSink& sink) {
  SegmentConsumer consumer{sink};
  Walk(mesh, axis, consumer, feeder);
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(GridCountCells);
HWY_EXPORT(GridIntegrateScalar);
HWY_EXPORT(GridFindIsosurface);
HWY_EXPORT(GridWalkSegments);

void count_cells(const WalkableGrid& mesh, int axis, PacketFeeder& feeder,
                 std::span<std::uint32_t> counts) {
  HWY_DYNAMIC_DISPATCH(GridCountCells)(mesh, axis, feeder, counts);
}

void integrate_scalar(const WalkableGrid& mesh, int axis, PacketFeeder& feeder,
                      std::span<PacketIntegral> sums) {
  HWY_DYNAMIC_DISPATCH(GridIntegrateScalar)(mesh, axis, feeder, sums);
}

void find_isosurface(const WalkableGrid& mesh, int axis, float isovalue, PacketFeeder& feeder,
                     std::span<PacketHit> hits) {
  HWY_DYNAMIC_DISPATCH(GridFindIsosurface)(mesh, axis, isovalue, feeder, hits);
}

void walk_segments(const WalkableGrid& mesh, int axis, PacketFeeder& feeder,
                   PacketSegmentSink& sink) {
  HWY_DYNAMIC_DISPATCH(GridWalkSegments)(mesh, axis, feeder, sink);
}

}  // namespace plume
#endif  // HWY_ONCE
