/// Where a ray comes into a mesh: Embree finds candidates, the edges decide.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "plume/traverse/cell_walker.h"
#include "plume/traverse/grid_walker.h"
#include "plume/traverse/tet_walker.h"

namespace plume {

/// One way into a mesh along a ray. Entries are ordered by z along the ray, then by the number of
/// the boundary face, then by rank (for a face of winding 2 or more).
struct Entry {
  Crossing place{0, 0};
  std::uint32_t boundary = 0;  ///< number in the mesh's list of boundary faces
  std::uint32_t rank = 0;
  std::uint32_t ranks = 1;  ///< ways in through this face
};

/// A bounding volume hierarchy (Embree's, in robust mode) over a mesh's boundary faces.
///
/// The faces' boxes are widened by more than rounding can move a face against the ray, so that
/// every face whose winding is not zero is among the candidates; the winding alone says whether it
/// is hit. Entries are enumerated in their order, each once, however close together they are.
template <class Walker>
class BoundaryIndex {
 public:
  using Mesh = typename Walker::Mesh;

  /// Builds the hierarchy, in parallel. The mesh must outlive it. Throws Error where Embree fails.
  explicit BoundaryIndex(const Mesh& mesh);
  ~BoundaryIndex();
  BoundaryIndex(BoundaryIndex&&) noexcept;
  BoundaryIndex& operator=(BoundaryIndex&&) noexcept;

  /// The first entry of the ray, or the next one after `previous`; nothing where there is none.
  std::optional<Entry> next_entry(const Walker& walker, const ShearedFrame& frame,
                                  const Entry* previous) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

extern template class BoundaryIndex<TetWalker>;
extern template class BoundaryIndex<GridWalker>;
extern template class BoundaryIndex<CellWalker>;

}  // namespace plume
