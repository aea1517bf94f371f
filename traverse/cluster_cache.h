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

  /// Of cells alone, where they have up to eight corners, laid out as CornerCell's.
  alignas(64) float position[3][8][kClusterSize];
  /// The least and greatest at the corners of each face, widened.
  alignas(64) float face_least[6][kClusterSize], face_greatest[6][kClusterSize];
  unsigned has_corners = 0;  ///< one bit a cell

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
    take(p.scalar, least[place], greatest[place]);
  }
  void set_corners(std::size_t place, const std::array<const WalkablePoint*, 8>& corners) {
    has_corners |= 1u << place;
    for (std::size_t c = 0; c < 8; ++c)
      for (std::size_t a = 0; a < 3; ++a) position[a][c][place] = corners[c]->position[a];
    for (std::size_t f = 0; f < 6; ++f) {
      float& from = face_least[f][place] = Cluster::kInfinity;
      float& to = face_greatest[f][place] = -Cluster::kInfinity;
      for (const std::uint8_t c : kCornerLoop[f]) take(corners[c]->scalar, from, to);
      CellClusters::widen(from, to);
    }
  }

 private:
  static void take(float scalar, float& first, float& last) {
    // A comparison with NaN is false.
    first = scalar < first ? scalar : first;
    last = scalar > last ? scalar : last;
  }
};

/// The corners of a cell, in CornerCell's layout; false where it has none.
inline bool find_corners(const WalkableGrid& mesh, std::uint32_t cell,
                         std::array<const WalkablePoint*, 8>& corners) {
  const std::uint32_t first = mesh.first_point(cell), row = mesh.dimensions[0];
  const std::uint32_t plane = row * mesh.dimensions[1];
  for (std::uint32_t c = 0; c < 8; ++c)
    corners[c] = &mesh.points[first + (c & 1) + (c >> 1 & 1) * row + (c >> 2) * plane];
  return true;
}
inline bool find_corners(const WalkableCells& mesh, std::uint32_t cell,
                         std::array<const WalkablePoint*, 8>& corners) {
  if (mesh.corner_cells.empty() || mesh.corner_cells[cell].other != 0) return false;
  for (std::size_t c = 0; c < 8; ++c) corners[c] = &mesh.points[mesh.corner_cells[cell].points[c]];
  return true;
}

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

/// As LeafCache, of CellClusters: each thread keeps some, 0.9 MB, from bundle to bundle.
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
    place.has_corners = 0;
    std::array<const WalkablePoint*, 8> corners;
    for (std::size_t i = 0; i < kClusterSize; ++i) {
      place.clear(i);
      if (i >= place.size) continue;
      if (find_corners(*mesh_, cells.cell[i], corners)) {
        for (const WalkablePoint* corner : corners) place.add(i, *corner);
        place.set_corners(i, corners);
      } else {
        for_each_point_of(*mesh_, cells.cell[i],
                          [&](std::uint32_t point) { place.add(i, mesh_->points[point]); });
      }
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
