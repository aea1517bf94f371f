/// Meshes walked by packets of rays with the widest instructions that the processor has.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "plume/mesh/walkable_cells.h"
#include "plume/mesh/walkable_grid.h"
#include "plume/mesh/walkable_rectilinear.h"
#include "plume/mesh/walkable_tets.h"
#include "plume/traverse/packet_start.h"

namespace plume {

/// Walks all rays of `feeder` and counts, by PacketStart::ray, the cells that each went through
/// (added to what is there). The rays' longest axis must be `axis`, 0 to 2; their starts are
/// TetStart, GridStart or CellStart, as the mesh is. Takes the same way as TetWalker, GridWalker or
/// CellWalker, bit for bit, with any instruction set. WalkableCells must have
/// their packets prepared (prepare_packets()).
///
/// A rectilinear grid is walked as RectilinearWalker does, on rays of all axes together; starts are
/// RectilinearStart, and the grid one that is walked_by_packets() (traverse/rectilinear_start.h).
void count_cells(const WalkableTets& mesh, int axis, PacketFeeder& feeder,
                 std::span<std::uint32_t> counts);
void count_cells(const WalkableGrid& mesh, int axis, PacketFeeder& feeder,
                 std::span<std::uint32_t> counts);
void count_cells(const WalkableCells& mesh, int axis, PacketFeeder& feeder,
                 std::span<std::uint32_t> counts);
void count_cells(const WalkableRectilinear& mesh, PacketFeeder& feeder,
                 std::span<std::uint32_t> counts);

/// The line integral of the scalar along the passages of a ray.
struct PacketIntegral {
  float length = 0;    ///< of the passages, in world units
  float integral = 0;  ///< of the scalar over that length
  std::uint32_t cells = 0;
};

/// Walks all rays of `feeder` and adds, by PacketStart::ray, what they meet to what is there. The
/// scalar is that of the points, 0 in a rectilinear grid that has none. Sums are in single
/// precision: after n cells their error is n units in the last place at the most, and about the
/// square root of that.
void integrate_scalar(const WalkableTets& mesh, int axis, PacketFeeder& feeder,
                      std::span<PacketIntegral> sums);
void integrate_scalar(const WalkableGrid& mesh, int axis, PacketFeeder& feeder,
                      std::span<PacketIntegral> sums);
void integrate_scalar(const WalkableCells& mesh, int axis, PacketFeeder& feeder,
                      std::span<PacketIntegral> sums);
void integrate_scalar(const WalkableRectilinear& mesh, PacketFeeder& feeder,
                      std::span<PacketIntegral> sums);

/// Where a ray first meets an isosurface.
struct PacketHit {
  /// In world units from where the last of its passages came in; infinite where there is none.
  float distance = std::numeric_limits<float>::infinity();
  std::uint32_t cells = 0;
};

/// Walks the rays of `feeder` to the first place where the points' scalar passes through
/// `isovalue`; a value equal to it counts as above. Cells are added to what is there. A ray that
/// was not hit may come back with its next passage.
void find_isosurface(const WalkableTets& mesh, int axis, float isovalue, PacketFeeder& feeder,
                     std::span<PacketHit> hits);
void find_isosurface(const WalkableGrid& mesh, int axis, float isovalue, PacketFeeder& feeder,
                     std::span<PacketHit> hits);
void find_isosurface(const WalkableCells& mesh, int axis, float isovalue, PacketFeeder& feeder,
                     std::span<PacketHit> hits);
void find_isosurface(const WalkableRectilinear& mesh, float isovalue, PacketFeeder& feeder,
                     std::span<PacketHit> hits);

/// Segments of packets, for tests: what every lane met, in the order in which it did.
struct PacketSegment {
  std::uint32_t ray, cell;
  float length, s_in, s_out;
};

/// Walks all rays of `feeder` and hands out their segments. Lengths are in world units. Slow.
class PacketSegmentSink {
 public:
  virtual ~PacketSegmentSink() = default;
  virtual void take(const PacketSegment& segment) = 0;
};
void walk_segments(const WalkableTets& mesh, int axis, PacketFeeder& feeder,
                   PacketSegmentSink& sink);
void walk_segments(const WalkableGrid& mesh, int axis, PacketFeeder& feeder,
                   PacketSegmentSink& sink);
void walk_segments(const WalkableCells& mesh, int axis, PacketFeeder& feeder,
                   PacketSegmentSink& sink);
void walk_segments(const WalkableRectilinear& mesh, PacketFeeder& feeder, PacketSegmentSink& sink);

/// The instruction set that is used: "AVX3", "AVX2", "SSE4", "NEON", ...
const char* packet_instruction_set();

/// Forbids all but the named instruction sets (0: allows all again), for tests and benchmarks; true
/// where something is left. Bits as Highway's HWY_SSE4 and so on.
void limit_packet_instruction_sets(std::int64_t targets);

}  // namespace plume
