#include "plume/mesh/cell_hierarchy.h"

#include <algorithm>

#include "plume/mesh/boundary_clusters.h"
#include "plume/mesh/leaf_cells.h"
#include "plume/mesh/leaf_summary.h"

namespace plume {
CellHierarchy make_cell_hierarchy(const WalkableTets& mesh) {
  CellHierarchy made;
  made.cell_count = static_cast<std::uint32_t>(mesh.cell_count());
  made.leaves.resize((mesh.cell_count() + kLeafCells - 1) / kLeafCells);
  made.cells = make_cluster_tree(made.leaves.size(), [&](std::size_t leaf) {
    // The neighbours of the cells of the leaf after the next are fetched meanwhile.
    const std::size_t ahead = std::min(mesh.cell_count(), kLeafCells * (leaf + 2));
    for (std::size_t c = ahead; c < std::min(mesh.cell_count(), ahead + kLeafCells); ++c)
      for (const WalkableTets::Link& link : mesh.cells[c])
        if (link.cell != kNone) __builtin_prefetch(&mesh.cells[link.cell]);
    CellHierarchy::Leaf& kept = made.leaves[leaf];
    LeafCells cells;
    cells.read(mesh, static_cast<std::uint32_t>(leaf));
    const LeafSummary summary = summarize(cells);
    kept.thin = static_cast<std::uint16_t>(summary.thin);
    kept.ranges = summary.ranges;
    return Cluster{summary.low, summary.high, summary.least, summary.greatest, summary.thin != 0};
  });
  made.boundary = make_boundary_clusters(mesh);
  return made;
}

}  // namespace plume
