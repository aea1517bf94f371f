#include "plume/mesh/cell_clusters.h"

#include "plume/mesh/crooked_cell.h"
#include "plume/mesh/space_curve.h"

namespace plume {
namespace {

// Blocks along each axis.
std::array<std::uint32_t, 3> blocks_of(const WalkableGrid& mesh) {
  std::array<std::uint32_t, 3> blocks;
  for (std::size_t a = 0; a < 3; ++a)
    blocks[a] = (mesh.dimensions[a] - 1 + kGridBlock[a] - 1) / kGridBlock[a];
  return blocks;
}

// Blocks along a space-filling curve through the grid's indices.
std::vector<std::uint32_t> order_blocks(const WalkableGrid& mesh) {
  const auto blocks = blocks_of(mesh);
  const std::size_t count =
      std::size_t{blocks[0]} * std::size_t{blocks[1]} * std::size_t{blocks[2]};
  float longest = 1;
  for (std::size_t a = 0; a < 3; ++a)
    longest = std::max(longest, static_cast<float>(kGridBlock[a] * blocks[a]));
  return hilbert_order(count, [&](std::size_t block) {
    const std::array<std::size_t, 3> at{block % blocks[0], block / blocks[0] % blocks[1],
                                        block / blocks[0] / blocks[1]};
    std::array<float, 3> position;
    for (std::size_t a = 0; a < 3; ++a)
      position[a] =
          2 * (static_cast<float>(at[a]) + 0.5f) * static_cast<float>(kGridBlock[a]) / longest - 1;
    return position;
  });
}

// Along a curve through space: in the list, faces that follow each other may be on opposite sides.
std::vector<std::uint32_t> order_faces(const WalkableGrid& mesh) {
  return hilbert_order(mesh.boundary.size(), [&](std::size_t face) {
    std::array<float, 3> middle{0, 0, 0};
    for_each_point_of(mesh, mesh.boundary[face], [&](std::uint32_t point) {
      for (std::size_t a = 0; a < 3; ++a) middle[a] += mesh.points[point].position[a] / 4;
    });
    return middle;
  });
}

template <class Mesh>
void make_trees(const Mesh& mesh, CellClusters& made) {
  made.cells = make_cluster_tree(made.leaf_count(), [&](std::size_t leaf) {
    Cluster cluster;
    const CellClusters::Cells cells = made.cells_of(mesh, leaf);
    unsigned crooked = 0;
    for (std::size_t place = 0; place < cells.size; ++place) {
      for_each_point_of(mesh, cells.cell[place], [&](std::uint32_t point) {
        const WalkablePoint& p = mesh.points[point];
        cluster.add(p.position);
        // A comparison with NaN is false.
        cluster.least = p.scalar < cluster.least ? p.scalar : cluster.least;
        cluster.greatest = p.scalar > cluster.greatest ? p.scalar : cluster.greatest;
      });
      crooked |= (is_crooked(mesh, cells.cell[place]) ? 1u : 0u) << place;
    }
    CellClusters::widen(cluster.least, cluster.greatest);
    made.crooked[leaf] = static_cast<std::uint16_t>(crooked);
    cluster.special = crooked != 0;
    return cluster;
  });
  const std::size_t faces = mesh.boundary.size();
  made.boundary =
      make_cluster_tree((faces + kClusterSize - 1) / kClusterSize, [&](std::size_t leaf) {
        Cluster cluster;
        cluster.least = cluster.greatest = 0;
        for (std::size_t f = 0; f < std::min(kClusterSize, faces - kClusterSize * leaf); ++f)
          for_each_point_of(mesh, mesh.boundary[made.face(leaf, f)],
                            [&](std::uint32_t point) { cluster.add(mesh.points[point].position); });
        return cluster;
      });
}

}  // namespace

CellClusters::Cells CellClusters::cells_of(const WalkableGrid& mesh, std::size_t leaf) const {
  Cells found;
  const auto along = blocks_of(mesh);
  const std::uint32_t block = blocks[leaf];
  const std::array<std::uint32_t, 3> at{block % along[0], block / along[0] % along[1],
                                        block / along[0] / along[1]};
  const std::uint32_t ci = mesh.dimensions[0] - 1, cj = mesh.dimensions[1] - 1;
  auto end = [&](std::size_t a) {
    return std::min(kGridBlock[a] * (at[a] + 1), mesh.dimensions[a] - 1);
  };
  for (std::uint32_t k = kGridBlock[2] * at[2]; k < end(2); ++k)
    for (std::uint32_t j = kGridBlock[1] * at[1]; j < end(1); ++j)
      for (std::uint32_t i = kGridBlock[0] * at[0]; i < end(0); ++i) {
        const std::uint32_t cell = i + ci * (j + cj * k);
        if (mesh.hidden.empty() || !mesh.hidden[cell]) found.cell[found.size++] = cell;
      }
  return found;
}

CellClusters::Cells CellClusters::cells_of(const WalkableCells& mesh, std::size_t leaf) const {
  Cells found;
  const std::size_t first = kClusterSize * leaf;
  found.size = std::min(kClusterSize, mesh.cell_count() - first);
  for (std::size_t i = 0; i < found.size; ++i)
    found.cell[i] = static_cast<std::uint32_t>(first + i);
  return found;
}

CellClusters make_cell_clusters(const WalkableGrid& mesh) {
  CellClusters made;
  made.blocks = order_blocks(mesh);
  made.faces = order_faces(mesh);
  made.crooked.resize(made.blocks.size());
  make_trees(mesh, made);
  return made;
}

CellClusters make_cell_clusters(const WalkableCells& mesh) {
  CellClusters made;
  made.crooked.resize((mesh.cell_count() + kClusterSize - 1) / kClusterSize);
  make_trees(mesh, made);
  return made;
}

}  // namespace plume
