/// The meshes on which walkers are timed.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "plume/mesh/local_frame.h"
#include "plume/mesh/mesh.h"
#include "plume/mesh/walkable_cells.h"
#include "plume/mesh/walkable_grid.h"
#include "plume/mesh/walkable_tets.h"
#include "plume/tests/bench/passage_consumers.h"
#include "plume/tests/bench/plucker_walker.h"

namespace plume::bench {

/// Meshes that the same walkers walk.
enum class Family : std::uint8_t { tetrahedra, hexahedra, cells };
const char* family_name(Family family);

/// One mesh in the form of each walker of its family; what other families walk is empty.
struct BenchMesh {
  Family family = Family::tetrahedra;
  Bounds bounds;
  /// Largest absolute value of the scalar.
  float scalar_size = 0;
  std::size_t cell_count = 0;
  WalkableTets tets;
  WalkableTets compact_tets;  // the same, with compact cells
  PluckerMesh plucker;
  WalkableGrid grid;
  WalkableCells cells;
  BenchOptics optics;
};

/// What a walker reads of it.
template <class Form>
const Form& form_of(const BenchMesh& mesh) {
  if constexpr (std::is_same_v<Form, WalkableTets>)
    return mesh.tets;
  else if constexpr (std::is_same_v<Form, WalkableGrid>)
    return mesh.grid;
  else
    return mesh.cells;
}

enum class CellOrder {
  hilbert,
  /// Cells, not points, in an order that has nothing to do with space: what a mesh is like whose
  /// maker did not care.
  random,
};

/// Traces the mesh's active field. A grid is of the family of hexahedra; any explicit cells may be
/// of the family of cells; the order is for tetrahedra alone. The isovalue is halfway between the
/// 1st and the 99th percentile of the points' values; the optics are such that a ray across the
/// bounds' diagonal at the highest value has an optical depth of 8.
BenchMesh make_bench_mesh(const Mesh& mesh, Family family = Family::tetrahedra,
                          CellOrder order = CellOrder::hilbert);

/// A grid's hexahedra cut into six tetrahedra each around the diagonal from corner 0 to corner 6
/// (Kuhn), in the order of i, j and k, so that the faces of neighbours match.
Mesh cut_into_tetrahedra(const Mesh& grid);

struct MeshSource {
  Family family;
  std::string name;
  /// Pixels along each side of a view.
  int resolution;
  /// Of a view's tiles, one in so many is walked: in the quick run (0: no part of it), and in the
  /// one of all meshes.
  std::uint64_t quick_tiles, tiles;
  CellOrder order;
  /// Nothing where the file is absent: that is said on stderr, loudly.
  std::function<std::optional<Mesh>()> load;
};

/// Tetrahedra: the blunt fin in the thesis' 224,874, and jittered boxes of 1, 10 and 50 million.
/// Hexahedra: the thesis' two grids, and one whose every face but the boundary's is twisted.
/// Cells: jittered boxes of some 48,000 cells of one kind, or of all kinds mixed, before which
/// comes one in the family of tetrahedra to compare with.
const std::vector<MeshSource>& mesh_sources(Family family = Family::tetrahedra);

}  // namespace plume::bench
