#include "plume/mesh/cell_hierarchy.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "plume/mesh/leaf_cells.h"

namespace plume {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

constexpr std::size_t kLeaf = kLeafCells;

// A bit for each cell whose volume is not positive, or that is somewhere thinner than kLeastWidth.
// A cell's width is six times its volume divided by twice the area of a face, or by the cross
// product of two opposite edges. Rounding is far below what a point may be moved by.
unsigned thin_cells(const LeafCells& p) {
  constexpr float kSquared = kLeastWidth * kLeastWidth;
  alignas(64) int wide[kLeaf];
  for (std::size_t i = 0; i < kLeaf; ++i) {
    const float ax = p.position[0][1][i] - p.position[0][0][i],
                ay = p.position[1][1][i] - p.position[1][0][i];
    const float az = p.position[2][1][i] - p.position[2][0][i];
    const float bx = p.position[0][2][i] - p.position[0][0][i],
                by = p.position[1][2][i] - p.position[1][0][i];
    const float bz = p.position[2][2][i] - p.position[2][0][i];
    const float cx = p.position[0][3][i] - p.position[0][0][i],
                cy = p.position[1][3][i] - p.position[1][0][i];
    const float cz = p.position[2][3][i] - p.position[2][0][i];
    const float abx = ay * bz - az * by, aby = az * bx - ax * bz, abz = ax * by - ay * bx;
    const float bcx = by * cz - bz * cy, bcy = bz * cx - bx * cz, bcz = bx * cy - by * cx;
    const float cax = cy * az - cz * ay, cay = cz * ax - cx * az, caz = cx * ay - cy * ax;
    const float sign = (p.odd >> i & 1) != 0 ? -1.0f : 1.0f;
    const float volume = sign * (abx * cx + aby * cy + abz * cz);
    auto squared = [](float x, float y, float z) { return x * x + y * y + z * z; };
    const float squares[7] = {squared(abx, aby, abz),
                              squared(bcx, bcy, bcz),
                              squared(cax, cay, caz),
                              squared(abx + bcx, aby + bcy, abz + bcz),
                              squared(bcx + cax, bcy + cay, bcz + caz),
                              squared(cax + abx, cay + aby, caz + abz),
                              squared(abx + bcx + cax, aby + bcy + cay, abz + bcz + caz)};
    float largest = squares[0];
    for (std::size_t s = 1; s < 7; ++s) largest = squares[s] > largest ? squares[s] : largest;
    wide[i] =
        static_cast<int>(volume > 0) & static_cast<int>(volume * volume >= kSquared * largest);
  }
  unsigned thin = 0;
  for (std::size_t i = 0; i < kLeaf; ++i) thin |= (wide[i] != 0 ? 0u : 1u) << i;
  return thin;
}

// Halving, so that compilers use vectors. Destroys the values.
float least_of(float* values) {
  for (std::size_t half = kLeaf / 2; half > 0; half /= 2)
    for (std::size_t i = 0; i < half; ++i)
      values[i] = values[half + i] < values[i] ? values[half + i] : values[i];
  return values[0];
}
float greatest_of(float* values) {
  for (std::size_t half = kLeaf / 2; half > 0; half /= 2)
    for (std::size_t i = 0; i < half; ++i)
      values[i] = values[half + i] > values[i] ? values[half + i] : values[i];
  return values[0];
}

struct Cluster {
  std::array<float, 3> low{kInfinity, kInfinity, kInfinity};
  std::array<float, 3> high{-kInfinity, -kInfinity, -kInfinity};
  float least = kInfinity, greatest = -kInfinity;
  bool special = false;

  void add(const LeafCells& cells) {
    float lows[kLeaf], highs[kLeaf];
    for (std::size_t a = 0; a < 3; ++a) {
      LeafCells::bound(cells.position[a], lows, highs);
      low[a] = least_of(lows);
      high[a] = greatest_of(highs);
    }
  }

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

// The leaf's range, and the cells' in sixteenths of it.
void take_ranges(const LeafCells& cells, Cluster& cluster, CellHierarchy::Leaf& leaf) {
  float least[kLeaf], greatest[kLeaf], lows[kLeaf], highs[kLeaf];
  LeafCells::bound(cells.scalar, least, greatest);
  for (std::size_t i = 0; i < kLeaf; ++i) widen_range(least[i], greatest[i]);
  // Where a cell has no value, widening makes NaN, which is never less than anything.
  for (std::size_t i = 0; i < kLeaf; ++i) {
    lows[i] = least[i] < kInfinity ? least[i] : kInfinity;
    highs[i] = greatest[i] > -kInfinity ? greatest[i] : -kInfinity;
  }
  cluster.least = least_of(lows);
  cluster.greatest = greatest_of(highs);
  const CellHierarchy::Sixteenths sixteenths(cluster.least, cluster.greatest);
  int first[kLeaf], last[kLeaf];
  for (std::size_t i = 0; i < kLeaf; ++i) {
    first[i] = sixteenths.of(least[i]);
    last[i] = sixteenths.of(greatest[i]);
  }
  for (std::size_t i = 0; i < kLeaf; ++i)
    leaf.ranges[i] =
        static_cast<std::uint8_t>(least[i] <= greatest[i] ? first[i] | last[i] << 4 : 15);
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
    const unsigned thin = thin_cells(cells), special = cells.boundary | thin;
    kept.special = static_cast<std::uint16_t>(special);
    kept.thin = static_cast<std::uint16_t>(thin);
    Cluster cluster;
    cluster.add(cells);
    cluster.special = special != 0;
    take_ranges(cells, cluster, kept);
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
