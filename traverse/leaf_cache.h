/// Leaves of a hierarchy that were read lately.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "plume/mesh/boundary_clusters.h"
#include "plume/mesh/cell_hierarchy.h"
#include "plume/mesh/leaf_cells.h"

namespace plume {

/// A leaf's cells with their boxes and ranges, laid out for vectors.
struct ReadLeaf {
  std::uint32_t leaf = kNone;
  unsigned have = 0;  ///< a bit for each cell that was read; the others mean nothing
  LeafCells cells;
  alignas(64) float low[3][kLeafCells], high[3][kLeafCells];
  alignas(64) float least[kLeafCells], greatest[kLeafCells];
};

/// The faces of a leaf of the tree over the boundary, laid out for vectors. A leaf that is not full
/// has its last face several times.
struct LeafFaces {
  std::uint32_t leaf = kNone;
  std::size_t size = 0;
  alignas(64) float position[3][3][kLeafFaces];
  alignas(64) float low[3][kLeafFaces], high[3][kLeafFaces];
};

/// As LeafCache, of a mesh's boundary.
class FaceCache {
 public:
  FaceCache(const WalkableTets& mesh, const ClusterTree& tree)
      : mesh_(&mesh), tree_(&tree), leaves_(kLeaves) {}

  const ClusterTree& tree() const { return *tree_; }
  /// The number in the mesh's list of a face of a leaf.
  static std::uint32_t number_of(const LeafFaces& leaf, std::uint32_t place) {
    return static_cast<std::uint32_t>(kLeafFaces) * leaf.leaf + place;
  }
  /// Valid until the next call.
  const LeafFaces& read(std::uint32_t leaf) {
    LeafFaces& place = leaves_[leaf % kLeaves];
    if (place.leaf == leaf) return place;
    place.leaf = leaf;
    const std::size_t begin = kLeafFaces * leaf;
    place.size = std::min(mesh_->boundary.size() - begin, kLeafFaces);
    for (std::size_t i = 0; i < kLeafFaces; ++i) {
      const auto& loop = mesh_->boundary[begin + std::min(i, place.size - 1)].loop;
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t a = 0; a < 3; ++a)
          place.position[a][c][i] = mesh_->points[loop[c]].position[a];
    }
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t i = 0; i < kLeafFaces; ++i) {
        const auto& at = place.position[a];
        place.low[a][i] = std::min(at[0][i], std::min(at[1][i], at[2][i]));
        place.high[a][i] = std::max(at[0][i], std::max(at[1][i], at[2][i]));
      }
    return place;
  }
  /// A leaf will be read soon.
  void ask_for(std::uint32_t leaf) const {
    if (leaves_[leaf % kLeaves].leaf != leaf)
      __builtin_prefetch(&mesh_->boundary[kLeafFaces * leaf]);
  }

 private:
  static constexpr std::size_t kLeaves = 64;

  const WalkableTets* mesh_;
  const ClusterTree* tree_;
  std::vector<LeafFaces> leaves_;
};

/// To read the cells of a leaf takes longer than to look through them, and bundles of neighbouring
/// rays meet the same leaves: each thread keeps some, 0.4 MB, from bundle to bundle.
class LeafCache {
 public:
  LeafCache(const WalkableTets& mesh, const CellHierarchy& hierarchy)
      : mesh_(&mesh), hierarchy_(&hierarchy), faces_(mesh, hierarchy.boundary), leaves_(kLeaves) {}

  const WalkableTets& mesh() const { return *mesh_; }
  FaceCache& faces() { return faces_; }
  const CellHierarchy& hierarchy() const { return *hierarchy_; }

  /// Has at least the cells of a leaf whose bits are set. Valid until the next call.
  const ReadLeaf& read(std::uint32_t leaf, unsigned wanted) {
    ReadLeaf& place = leaves_[place_of(leaf)];
    if (place.leaf != leaf) place.have = 0;
    const unsigned missing = wanted & ~place.have;
    if (missing == 0) return place;
    place.leaf = leaf;
    place.have |= missing;
    place.cells.read(*mesh_, leaf, missing);
    for (std::size_t a = 0; a < 3; ++a)
      LeafCells::bound(place.cells.position[a], place.low[a], place.high[a]);
    LeafCells::bound(place.cells.scalar, place.least, place.greatest);
    for (std::size_t i = 0; i < kLeafCells; ++i) widen_range(place.least[i], place.greatest[i]);
    return place;
  }

  /// A leaf will be read soon: asks for its cells.
  void ask_for(std::uint32_t leaf) const {
    __builtin_prefetch(&hierarchy_->leaves[leaf]);
    if (leaves_[place_of(leaf)].leaf == leaf) return;
    const std::size_t begin = kLeafCells * leaf;
    const std::size_t end = std::min(mesh_->cell_count(), begin + kLeafCells);
    for (std::size_t cell = begin; cell < end; cell += 2) __builtin_prefetch(&mesh_->cells[cell]);
  }

 private:
  static constexpr int kBits = 8;
  static constexpr std::size_t kLeaves = std::size_t{1} << kBits;

  static std::size_t place_of(std::uint32_t leaf) { return leaf * 0x9E3779B1u >> (32 - kBits); }

  const WalkableTets* mesh_;
  const CellHierarchy* hierarchy_;
  FaceCache faces_;
  std::vector<ReadLeaf> leaves_;
};

}  // namespace plume
