#include "plume/traverse/packets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/traverse/cell_packets.cpp"
#include "hwy/foreach_target.h"
#include "plume/traverse/cell_steps-inl.h"
#include "plume/traverse/packet_consumers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void CellCountCells(const WalkableCells& mesh, int axis, PacketFeeder& feeder,
                    std::span<std::uint32_t> counts) {
  CountConsumer consumer{counts};
  Walk(mesh, axis, consumer, feeder);
}

void CellIntegrateScalar(const WalkableCells& mesh, int axis, PacketFeeder& feeder,
                         std::span<PacketIntegral> sums) {
  IntegralConsumer consumer{sums};
  Walk(mesh, axis, consumer, feeder);
}

void CellFindIsosurface(const WalkableCells& mesh, int axis, float isovalue, PacketFeeder& feeder,
                        std::span<PacketHit> hits) {
  IsosurfaceConsumer consumer{isovalue, hits};
  Walk(mesh, axis, consumer, feeder);
}

void CellWalkSegments(const WalkableCells& mesh, int axis, PacketFeeder& feeder,
                      PacketSegmentSink& sink) {
  SegmentConsumer consumer{sink};
  Walk(mesh, axis, consumer, feeder);
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(CellCountCells);
HWY_EXPORT(CellIntegrateScalar);
HWY_EXPORT(CellFindIsosurface);
HWY_EXPORT(CellWalkSegments);

void count_cells(const WalkableCells& mesh, int axis, PacketFeeder& feeder,
                 std::span<std::uint32_t> counts) {
  HWY_DYNAMIC_DISPATCH(CellCountCells)(mesh, axis, feeder, counts);
}

void integrate_scalar(const WalkableCells& mesh, int axis, PacketFeeder& feeder,
                      std::span<PacketIntegral> sums) {
  HWY_DYNAMIC_DISPATCH(CellIntegrateScalar)(mesh, axis, feeder, sums);
}

void find_isosurface(const WalkableCells& mesh, int axis, float isovalue, PacketFeeder& feeder,
                     std::span<PacketHit> hits) {
  HWY_DYNAMIC_DISPATCH(CellFindIsosurface)(mesh, axis, isovalue, feeder, hits);
}

void walk_segments(const WalkableCells& mesh, int axis, PacketFeeder& feeder,
                   PacketSegmentSink& sink) {
  HWY_DYNAMIC_DISPATCH(CellWalkSegments)(mesh, axis, feeder, sink);
}

}  // namespace plume
#endif  // HWY_ONCE
