/// The benchmarks of wedges, pyramids and polyhedra: what a face of theirs costs, against one of a
/// tetrahedron.
#pragma once

#include <string>
#include <vector>

#include "plume/tests/bench/passage_consumers.h"

namespace plume::bench {

struct CellsBenchOptions {
  int rounds = 3;
  /// Pixels along each side of a view; 0: as the meshes have them.
  int resolution = 0;
};

struct CellsResult {
  std::string mesh, walker;
  Mode mode = Mode::cells;
  std::size_t mesh_cells = 0;
  double bytes_per_cell = 0;
  double ns_per_cell = 0;
  /// Mean number of faces of the cells that are met, each as often as it is.
  double faces_per_cell = 0;
  /// Time by the sum of the faces of the cells that are met.
  double ns_per_face = 0;
  /// How many times what a tetrahedron's face costs the scalar walker, and packets.
  double to_tet_walker = 0, to_tet_packets = 0;
  /// A cell's time is that of a face that is crossed: how many times what one costs packets of
  /// tetrahedra.
  double crossed_to_tet_packets = 0;
};

/// Registers cells/<mode>/<mesh>/<walker> with Google Benchmark, in the modes cells and integral:
/// the unit cube in some 48,000 cells of each kind (mesh_sources), by CellWalker, and in
/// tetrahedra by TetWalker and packets. All take turns.
void register_cells_benchmarks(const CellsBenchOptions& options);

const std::vector<CellsResult>& cells_results();

/// True where meshes of the same cube were not of the same length along the same rays.
bool cells_bench_failed();

}  // namespace plume::bench
