/// Boxes and ranges of the scalar over clusters: what need not be looked at.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace plume {

/// What a tree keeps of a cluster of things. One that holds nothing is never looked at.
struct Cluster {
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::array<float, 3> low{kInfinity, kInfinity, kInfinity};
  std::array<float, 3> high{-kInfinity, -kInfinity, -kInfinity};
  float least = kInfinity, greatest = -kInfinity;
  bool special = false;

  void add(const float (&position)[3]) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], position[a]);
      high[a] = std::max(high[a], position[a]);
    }
  }
};

/// A tree over clusters in an order in which neighbours are near each other (its leaves): a node is
/// the boxes and ranges of kWidth children. Nothing points anywhere: child c of node n is node (or
/// leaf) kWidth * n + c of the level below. Some 37 bytes a leaf.
struct ClusterTree {
  static constexpr std::size_t kWidth = 8;

  /// The children, side by side, in the mesh's local frame. A child that is missing, or has no
  /// value, has the range [infinity, -infinity].
  struct alignas(64) Node {
    float low[3][kWidth], high[3][kWidth];
    float least[kWidth], greatest[kWidth];
  };
  /// Level by level, the parents of leaves first, the root last.
  std::vector<Node> nodes;
  /// One byte a node, one bit a child: whether there is something special in it, which whoever
  /// skips clusters must not skip.
  std::vector<std::uint8_t> special;
  /// Where each level begins in `nodes`, and after the last one their number.
  std::vector<std::uint32_t> levels;

  /// Levels of nodes; 0 where there is nothing.
  std::uint32_t depth() const {
    return levels.empty() ? 0 : static_cast<std::uint32_t>(levels.size() - 1);
  }
  std::size_t bytes() const {
    return nodes.size() * sizeof(Node) + special.size() + levels.size() * sizeof(std::uint32_t);
  }
};

/// In parallel: `cluster(leaf)` says what each leaf is.
template <class MakeCluster>
ClusterTree make_cluster_tree(std::size_t leaf_count, const MakeCluster& cluster) {
  constexpr std::size_t kWidth = ClusterTree::kWidth;
  ClusterTree made;
  if (leaf_count == 0) return made;
  std::vector<std::size_t> sizes{leaf_count};
  made.levels = {0};
  do {
    sizes.push_back((sizes.back() + kWidth - 1) / kWidth);
    made.levels.push_back(made.levels.back() + static_cast<std::uint32_t>(sizes.back()));
  } while (sizes.back() > 1);
  made.nodes.resize(made.levels.back());
  made.special.resize(made.levels.back());

  // Calls child(number) for the children of a level's nodes.
  auto for_each_node = [&](std::size_t level, std::size_t grain, const auto& child) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sizes[level + 1], grain),
                      [&](const auto& range) {
                        for (std::size_t n = range.begin(); n != range.end(); ++n) {
                          ClusterTree::Node& node = made.nodes[made.levels[level] + n];
                          unsigned special = 0;
                          for (std::size_t c = 0; c < kWidth; ++c) {
                            const std::size_t number = kWidth * n + c;
                            const Cluster of = number < sizes[level] ? child(number) : Cluster{};
                            const bool any = of.low[0] <= of.high[0];
                            for (std::size_t a = 0; a < 3; ++a) {
                              node.low[a][c] = any ? of.low[a] : 0;
                              node.high[a][c] = any ? of.high[a] : 0;
                            }
                            node.least[c] = of.least;
                            node.greatest[c] = of.greatest;
                            special |= (of.special ? 1u : 0u) << c;
                          }
                          made.special[made.levels[level] + n] = static_cast<std::uint8_t>(special);
                        }
                      });
  };
  for_each_node(0, 16, cluster);
  for (std::size_t level = 1; level + 1 < sizes.size(); ++level)
    for_each_node(level, 256, [&](std::size_t number) {
      const std::size_t below = made.levels[level - 1] + number;
      const ClusterTree::Node& node = made.nodes[below];
      const std::size_t children = std::min(kWidth, sizes[level - 1] - kWidth * number);
      Cluster all;
      for (std::size_t c = 0; c < children; ++c) {
        for (std::size_t a = 0; a < 3; ++a) {
          all.low[a] = std::min(all.low[a], node.low[a][c]);
          all.high[a] = std::max(all.high[a], node.high[a][c]);
        }
        all.least = std::min(all.least, node.least[c]);
        all.greatest = std::max(all.greatest, node.greatest[c]);
      }
      all.special = made.special[below] != 0;
      return all;
    });
  return made;
}

}  // namespace plume
