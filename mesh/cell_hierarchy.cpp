#include "plume/mesh/cell_hierarchy.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plume {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

constexpr std::size_t kLeaf = CellHierarchy::kLeafCells;

using Vector = std::array<float, 3>;

// The corners of a leaf's cells, laid out for compilers to use vectors; a leaf that is not full has
// its last cell several times.
struct LeafCorners {
  alignas(64) float x[4][kLeaf], y[4][kLeaf], z[4][kLeaf], scalar[4][kLeaf];
  alignas(64) float sign[kLeaf];  // -1 where the cell is odd

  void put(std::size_t place, const WalkableTets& mesh, std::uint32_t cell) {
    const auto points = mesh.points_of(cell);
    for (std::size_t i = 0; i < 4; ++i) {
      const WalkablePoint& p = mesh.points[points[i]];
      x[i][place] = p.position[0];
      y[i][place] = p.position[1];
      z[i][place] = p.position[2];
      scalar[i][place] = p.scalar;
    }
    sign[place] = mesh.is_odd(cell) ? -1.0f : 1.0f;
  }
};

// Whether the volumes of all cells are positive and the cells nowhere thinner than kLeastWidth. A
// cell's width is six times its volume divided by twice the area of a face, or by the cross product
// of two opposite edges. Rounding is far below what a point may be moved by.
bool all_wide(const LeafCorners& p) {
  constexpr float kSquared = kLeastWidth * kLeastWidth;
  int wide = 1;
  for (std::size_t i = 0; i < kLeaf; ++i) {
    const float ax = p.x[1][i] - p.x[0][i], ay = p.y[1][i] - p.y[0][i];
    const float az = p.z[1][i] - p.z[0][i];
    const float bx = p.x[2][i] - p.x[0][i], by = p.y[2][i] - p.y[0][i];
    const float bz = p.z[2][i] - p.z[0][i];
    const float cx = p.x[3][i] - p.x[0][i], cy = p.y[3][i] - p.y[0][i];
    const float cz = p.z[3][i] - p.z[0][i];
    const float abx = ay * bz - az * by, aby = az * bx - ax * bz, abz = ax * by - ay * bx;
    const float bcx = by * cz - bz * cy, bcy = bz * cx - bx * cz, bcz = bx * cy - by * cx;
    const float cax = cy * az - cz * ay, cay = cz * ax - cx * az, caz = cx * ay - cy * ax;
    const float volume = p.sign[i] * (abx * cx + aby * cy + abz * cz);
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
    wide &= static_cast<int>(volume > 0) &
            static_cast<int>(volume * volume >= kSquared * largest);
  }
  return wide != 0;
}

bool at_boundary(const WalkableTets::Cell& cell) {
  return cell[0].cell == kNone || cell[1].cell == kNone || cell[2].cell == kNone ||
         cell[3].cell == kNone;
}

struct Cluster {
  Vector low{kInfinity, kInfinity, kInfinity};
  Vector high{-kInfinity, -kInfinity, -kInfinity};
  float least = kInfinity, greatest = -kInfinity;
  bool special = false;

  void add(const LeafCorners& p) {
    auto range = [](const float(&values)[4][kLeaf], float& from, float& to) {
      // Comparisons with NaN are false.
      float lows[kLeaf], highs[kLeaf];
      std::fill_n(lows, kLeaf, kInfinity);
      std::fill_n(highs, kLeaf, -kInfinity);
      for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t i = 0; i < kLeaf; ++i) {
          lows[i] = values[c][i] < lows[i] ? values[c][i] : lows[i];
          highs[i] = values[c][i] > highs[i] ? values[c][i] : highs[i];
        }
      from = *std::min_element(lows, lows + kLeaf);
      to = *std::max_element(highs, highs + kLeaf);
    };
    range(p.x, low[0], high[0]);
    range(p.y, low[1], high[1]);
    range(p.z, low[2], high[2]);
    range(p.scalar, least, greatest);
  }

  // Makes room for what rounding adds to a scalar.
  void widen() {
    if (!(least <= greatest)) return;
    const double margin = CellHierarchy::kRounding *
                          std::max(std::abs(double{least}), std::abs(double{greatest}));
    if (const double below = least - margin; static_cast<float>(below) > below)
      least = std::nextafter(static_cast<float>(below), -kInfinity);
    else
      least = static_cast<float>(below);
    if (const double above = greatest + margin; static_cast<float>(above) < above)
      greatest = std::nextafter(static_cast<float>(above), kInfinity);
    else
      greatest = static_cast<float>(above);
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

}  // namespace

bool is_special(const WalkableTets& mesh, std::uint32_t cell) {
  if (at_boundary(mesh.cells[cell])) return true;
  LeafCorners corners;
  for (std::size_t i = 0; i < kLeaf; ++i) corners.put(i, mesh, cell);
  return !all_wide(corners);
}

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
    // The neighbours of cells so far ahead are fetched meanwhile.
    constexpr std::size_t kAhead = 2 * kLeaf;
    LeafCorners corners;
    Cluster cluster;
    for (std::size_t i = 0; i < kLeaf; ++i) {
      const std::size_t ahead = kLeaf * leaf + i + kAhead;
      if (ahead < mesh.cell_count())
        for (const WalkableTets::Link& link : mesh.cells[ahead])
          if (link.cell != kNone) __builtin_prefetch(&mesh.cells[link.cell]);
      const auto cell =
          static_cast<std::uint32_t>(std::min(kLeaf * leaf + i, mesh.cell_count() - 1));
      corners.put(i, mesh, cell);
      cluster.special = cluster.special || at_boundary(mesh.cells[cell]);
    }
    cluster.add(corners);
    cluster.special = cluster.special || !all_wide(corners);
    cluster.widen();
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
