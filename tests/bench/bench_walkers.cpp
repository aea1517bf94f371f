#include "plume/tests/bench/bench_walkers.h"

#include <algorithm>

#include "plume/tests/bench/packet_walker.h"
#include "plume/tests/bench/plucker_passages.h"
#include "plume/tests/bench/scalar_walks.h"

namespace plume::bench {
namespace {

std::size_t plucker_bytes(const BenchMesh& mesh) { return mesh.plucker.bytes(); }

std::size_t compact_bytes(const BenchMesh& mesh) {
  return mesh.compact_tets.bytes() -
         mesh.compact_tets.boundary.size() * sizeof(WalkableTets::Boundary);
}

std::size_t tets_bytes(const BenchMesh& mesh) {
  return mesh.tets.cells.size() * sizeof(WalkableTets::Cell) +
         mesh.tets.points.size() * sizeof(WalkablePoint);
}

std::size_t grid_bytes(const BenchMesh& mesh) {
  return mesh.grid.bytes() - mesh.grid.boundary.size() * sizeof(BoundaryFace);
}

// What CellWalker reads.
std::size_t cells_bytes(const BenchMesh& mesh) {
  return mesh.cells.bytes() - mesh.cells.boundary.size() * sizeof(BoundaryFace) -
         mesh.cells.corner_cells.size() * sizeof(CornerCell) - mesh.cells.edge_cells.bytes();
}

// What packets read, the points included.
std::size_t packet_bytes(const BenchMesh& mesh) {
  if (mesh.cells.corner_cells.empty()) return cells_bytes(mesh) + mesh.cells.edge_cells.bytes();
  return mesh.cells.corner_cells.size() * sizeof(CornerCell) +
         mesh.cells.points.size() * sizeof(WalkablePoint);
}

const std::vector<Mode> kAllModes(kModes.begin(), kModes.end());
const std::vector<Mode> kPacketModes{Mode::cells, Mode::integral, Mode::isosurface,
                                     Mode::closed_form};

}  // namespace

bool BenchWalker::has(Mode mode) const {
  return std::find(modes.begin(), modes.end(), mode) != modes.end();
}

const std::vector<BenchWalker>& walkers(Family family) {
  static const std::vector<BenchWalker> of_tetrahedra = [] {
    std::vector<BenchWalker> walkers{
        {"plucker", walk_thesis_plucker, kAllModes, Likeness::rounding, plucker_bytes},
        {"tet-walker", walk_passages<TetWalker>, kAllModes, Likeness::exact, tets_bytes},
        {"plucker-fast", walk_relative_plucker, kAllModes, Likeness::rounding, plucker_bytes},
        {"tet-packets", walk_packet_passages, kPacketModes, Likeness::exact, tets_bytes},
        {"compact", walk_compact_passages, kPacketModes, Likeness::exact, compact_bytes},
    };
    if (packets_have_more_than_avx2()) {
      walkers.push_back(
          {"packets-avx2", walk_packet_passages_avx2, kPacketModes, Likeness::exact, tets_bytes});
      walkers.push_back({"compact-avx2", walk_compact_passages_avx2, kPacketModes, Likeness::exact,
                         compact_bytes});
    }
    return walkers;
  }();
  static const std::vector<BenchWalker> of_hexahedra = [] {
    std::vector<BenchWalker> walkers{
        {"hybrid", walk_passages<HybridGridWalker>, kAllModes, Likeness::surface, grid_bytes},
        {"grid-walker", walk_passages<GridWalker>, kAllModes, Likeness::exact, grid_bytes},
        {"plucker", walk_passages<PluckerGridWalker>, kAllModes, Likeness::surface, grid_bytes},
        {"grid-packets", walk_packet_passages, kPacketModes, Likeness::exact, grid_bytes},
    };
    if (packets_have_more_than_avx2())
      walkers.push_back(
          {"packets-avx2", walk_packet_passages_avx2, kPacketModes, Likeness::exact, grid_bytes});
    return walkers;
  }();
  static const std::vector<BenchWalker> of_cells{
      {"cell-walker", walk_passages<CellWalker>, kAllModes, Likeness::exact, cells_bytes},
      {"cell-packets", walk_packet_passages, kPacketModes, Likeness::exact, packet_bytes}};
  return family == Family::tetrahedra  ? of_tetrahedra
         : family == Family::hexahedra ? of_hexahedra
                                       : of_cells;
}

const BenchWalker& baseline(Family family) { return walkers(family).front(); }
const BenchWalker& reference(Family family) {
  return family == Family::cells ? walkers(family).front() : walkers(family)[1];
}

}  // namespace plume::bench
