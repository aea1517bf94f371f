/// Leaves of CellClusters that were read lately.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "plume/mesh/cell_clusters.h"

namespace plume {

/// The cells of a leaf, or the faces of one at the boundary, with their boxes and ranges, laid out
/// for vectors; what is beyond `size` means nothing.
struct ReadCluster {
  std::uint32_t leaf = kNone;
  std::size_t size = 0;
  std::array<std::uint32_t, kClusterSize> number;  ///< of the cell, of the face in the mesh's list
  alignas(64) float low[3][kClusterSize], high[3][kClusterSize];
  alignas(64) float least[kClusterSize], greatest[kClusterSize];

  void clear(std::size_t place) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a][place] = Cluster::kInfinity;
      high[a][place] = -Cluster::kInfinity;
    }
    least[place] = Cluster::kInfinity;
    greatest[place] = -Cluster::kInfinity;
  }
  void add(std::size_t place, const WalkablePoint& p) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a][place] = std::min(low[a][place], p.position[a]);
      high[a][place] = std::max(high[a][place], p.position[a]);
    }
    // A comparison with NaN is false.
    least[place] = p.scalar < least[place] ? p.scalar : least[place];
    greatest[place] = p.scalar > greatest[place] ? p.scalar : greatest[place];
  }
};

/// As FaceCache, of other faces than triangles: their boxes alone.
template <class Mesh>
class FaceBoxCache {
 public:
  FaceBoxCache(const Mesh& mesh, const CellClusters& clusters)
      : mesh_(&mesh), clusters_(&clusters), leaves_(kLeaves) {}

  const ClusterTree& tree() const { return clusters_->boundary; }
  static std::uint32_t number_of(const ReadCluster& leaf, std::uint32_t place) {
    return leaf.number[place];
  }
  const ReadCluster& read(std::uint32_t leaf) {
    ReadCluster& place = leaves_[leaf % kLeaves];
    if (place.leaf == leaf) return place;
    place.leaf = leaf;
    place.size = std::min(mesh_->boundary.size() - kClusterSize * leaf, kClusterSize);
    for (std::size_t i = 0; i < kClusterSize; ++i) {
      place.clear(i);
      if (i >= place.size) continue;
      place.number[i] = clusters_->face(leaf, i);
      for_each_point_of(*mesh_, mesh_->boundary[place.number[i]],
                        [&](std::uint32_t point) { place.add(i, mesh_->points[point]); });
    }
    return place;
  }
  void ask_for(std::uint32_t /*leaf*/) const {}

 private:
  static constexpr std::size_t kLeaves = 64;

  const Mesh* mesh_;
  const CellClusters* clusters_;
  std::vector<ReadCluster> leaves_;
};

/// As LeafCache, of CellClusters: each thread keeps some, 0.2 MB, from bundle to bundle.
template <class W>
class ClusterCache {
 public:
  using Walker = W;
  using Mesh = typename Walker::Mesh;

  ClusterCache(const Mesh& mesh, const CellClusters& clusters)
      : mesh_(&mesh), clusters_(&clusters), faces_(mesh, clusters), leaves_(kLeaves) {}

  const Mesh& mesh() const { return *mesh_; }
  const CellClusters& clusters() const { return *clusters_; }
  FaceBoxCache<Mesh>& faces() { return faces_; }

  /// Valid until the next call.
  const ReadCluster& read(std::uint32_t leaf) {
    ReadCluster& place = leaves_[leaf % kLeaves];
    if (place.leaf == leaf) return place;
    const CellClusters::Cells cells = clusters_->cells_of(*mesh_, leaf);
    place.leaf = leaf;
    place.size = cells.size;
    place.number = cells.cell;
    for (std::size_t i = 0; i < kClusterSize; ++i) {
      place.clear(i);
      if (i >= place.size) continue;
      for_each_point_of(*mesh_, cells.cell[i],
                        [&](std::uint32_t point) { place.add(i, mesh_->points[point]); });
      CellClusters::widen(place.least[i], place.greatest[i]);
    }
    return place;
  }

 private:
  static constexpr std::size_t kLeaves = 256;

  const Mesh* mesh_;
  const CellClusters* clusters_;
  FaceBoxCache<Mesh> faces_;
  std::vector<ReadCluster> leaves_;
};

}  // namespace plume
