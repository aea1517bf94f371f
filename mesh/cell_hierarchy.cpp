#include "plume/mesh/cell_hierarchy.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "plume/mesh/leaf_cells.h"
#include "plume/mesh/leaf_summary.h"

namespace plume {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

constexpr std::size_t kLeaf = kLeafCells;

struct Cluster {
  std::array<float, 3> low{kInfinity, kInfinity, kInfinity};
  std::array<float, 3> high{-kInfinity, -kInfinity, -kInfinity};
  float least = kInfinity, greatest = -kInfinity;
  bool special = false;

  Cluster() = default;
  explicit Cluster(const LeafSummary& leaf)
      : low(leaf.low), high(leaf.high), least(leaf.least), greatest(leaf.greatest) {}

  // What is missing is never looked at, wherever its box is.
  void put(CellHierarchy::Node& node, std::size_t child) const {
    const bool any = low[0] <= high[0];
    for (std::size_t a = 0; a < 3; ++a) {
      node.low[a][child] = any ? low[a] : 0;
      node.high[a][child] = any ? high[a] : 0;
    }
    node.least[child] = least;
    node.greatest[child] = greatest;
  }
};

// The children of a node as one; of a node's missing children, none.
Cluster joined(const CellHierarchy::Node& node, std::size_t children) {
  Cluster all;
  for (std::size_t c = 0; c < children; ++c) {
    for (std::size_t a = 0; a < 3; ++a) {
      all.low[a] = std::min(all.low[a], node.low[a][c]);
      all.high[a] = std::max(all.high[a], node.high[a][c]);
    }
    all.least = std::min(all.least, node.least[c]);
    all.greatest = std::max(all.greatest, node.greatest[c]);
  }
  return all;
}

std::uint32_t first_boundary(const WalkableTets& mesh, std::uint32_t leaf) {
  const auto found = std::lower_bound(
      mesh.boundary.begin(), mesh.boundary.end(), kLeaf * leaf,
      [](const WalkableTets::Boundary& face, std::size_t cell) { return face.cell < cell; });
  return static_cast<std::uint32_t>(found - mesh.boundary.begin());
}

}  // namespace

CellHierarchy make_cell_hierarchy(const WalkableTets& mesh) {
  constexpr std::size_t kWidth = CellHierarchy::kWidth;
  CellHierarchy made;
  made.cell_count = static_cast<std::uint32_t>(mesh.cell_count());
  std::vector<std::size_t> sizes{(mesh.cell_count() + kLeaf - 1) / kLeaf};  // leaves first
  made.levels = {0};
  do {
    sizes.push_back((sizes.back() + kWidth - 1) / kWidth);
    made.levels.push_back(made.levels.back() + static_cast<std::uint32_t>(sizes.back()));
  } while (sizes.back() > 1);
  made.nodes.resize(made.levels.back());
  made.special.resize(made.levels.back());
  made.leaves.resize(sizes[0]);

  // Calls fill(node, children) for the nodes of a level.
  auto for_each_node = [&](std::size_t level, std::size_t grain, const auto& fill) {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, sizes[level + 1], grain), [&](const auto& range) {
          for (std::size_t n = range.begin(); n != range.end(); ++n)
            for (std::size_t c = 0; c < kWidth; ++c) {
              const std::size_t child = kWidth * n + c, node = made.levels[level] + n;
              const Cluster cluster = child < sizes[level] ? fill(child) : Cluster{};
              cluster.put(made.nodes[node], c);
              made.special[node] |=
                  static_cast<std::uint8_t>(static_cast<unsigned>(cluster.special) << c);
            }
        });
  };
  for_each_node(0, 16, [&](std::size_t leaf) {
    // The neighbours of the cells of the leaf after the next are fetched meanwhile.
    const std::size_t ahead = std::min(mesh.cell_count(), kLeaf * (leaf + 2));
    for (std::size_t c = ahead; c < std::min(mesh.cell_count(), ahead + kLeaf); ++c)
      for (const WalkableTets::Link& link : mesh.cells[c])
        if (link.cell != kNone) __builtin_prefetch(&mesh.cells[link.cell]);
    const auto number = static_cast<std::uint32_t>(leaf);
    CellHierarchy::Leaf& kept = made.leaves[leaf];
    kept.first_boundary = first_boundary(mesh, number);
    LeafCells cells;
    cells.read(mesh, number, kept.first_boundary);
    const LeafSummary summary = summarize(cells);
    const unsigned special = cells.boundary | summary.thin;
    kept.special = static_cast<std::uint16_t>(special);
    kept.thin = static_cast<std::uint16_t>(summary.thin);
    kept.ranges = summary.ranges;
    Cluster cluster(summary);
    cluster.special = special != 0;
    return cluster;
  });
  for (std::size_t level = 1; level + 1 < sizes.size(); ++level)
    for_each_node(level, 256, [&](std::size_t child) {
      const std::size_t below = made.levels[level - 1] + child;
      Cluster cluster =
          joined(made.nodes[below], std::min(kWidth, sizes[level - 1] - kWidth * child));
      cluster.special = made.special[below] != 0;
      return cluster;
    });
  return made;
}

}  // namespace plume
