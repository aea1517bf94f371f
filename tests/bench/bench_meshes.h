/// The meshes on which walkers are timed.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plume/mesh/local_frame.h"
#include "plume/mesh/mesh.h"
#include "plume/mesh/walkable_tets.h"
#include "plume/tests/bench/passage_consumers.h"
#include "plume/tests/bench/plucker_walker.h"

namespace plume::bench {

/// One mesh in the form of each walker.
struct BenchMesh {
  Bounds bounds;
  /// Largest absolute value of the scalar.
  float scalar_size = 0;
  WalkableTets tets;
  PluckerMesh plucker;
  BenchOptics optics;
};

enum class CellOrder {
  hilbert,
  /// Cells, not points, in an order that has nothing to do with space: what a mesh is like whose
  /// maker did not care.
  random,
};

/// Traces the mesh's active field. The isovalue is halfway between the 1st and the 99th percentile
/// of the points' values; the optics are such that a ray across the bounds' diagonal at the highest
/// value has an optical depth of 8.
BenchMesh make_bench_mesh(const Mesh& mesh, CellOrder order = CellOrder::hilbert);

/// A grid's hexahedra cut into six tetrahedra each around the diagonal from corner 0 to corner 6
/// (Kuhn), in the order of i, j and k, so that the faces of neighbours match.
Mesh cut_into_tetrahedra(const Mesh& grid);

struct MeshSource {
  std::string name;
  /// Pixels along each side of a view.
  int resolution;
  /// Of a view's tiles, one in so many is walked: in the run that takes less than a minute (0: no
  /// part of it), and in the one of all meshes.
  std::uint64_t quick_tiles, tiles;
  CellOrder order;
  /// Nothing where the file is absent: that is said on stderr, loudly.
  std::function<std::optional<Mesh>()> load;
};

/// The blunt fin in the thesis' 224,874 tetrahedra, and jittered boxes of 1, 10 and 50 million.
const std::vector<MeshSource>& mesh_sources();

}  // namespace plume::bench
