/// Where a ray comes into a mesh: Embree finds candidates, the edges decide.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "plume/traverse/cell_walker.h"
#include "plume/traverse/frame_lanes.h"
#include "plume/traverse/grid_walker.h"
#include "plume/traverse/tet_walker.h"

namespace plume {

/// One way into a mesh along a ray. Entries are ordered by z along the ray, then by the number of
/// the boundary face, then by rank.
struct Entry {
  Crossing place{0, 0};
  std::uint32_t boundary = 0;  ///< number in the mesh's list of boundary faces
  std::uint32_t rank = 0;      ///< which of the face's crossings
};

/// The next few entries of a ray, in order: enough for most rays in one query.
struct EntryList {
  static constexpr std::uint32_t kCapacity = 4;
  std::array<Entry, kCapacity> entries;
  std::uint32_t size = 0;
  /// There may be more behind the last one.
  bool more = false;

  void clear() {
    size = 0;
    more = false;
  }
};

/// A bounding volume hierarchy (Embree's, in robust mode) over a mesh's boundary faces.
///
/// The faces' boxes are widened by more than rounding can move a face against the ray, so that
/// every face that the ray crosses is among the candidates; the walker's rule alone says whether it
/// is hit, and how often: a face may be grazed, in and out again. Entries are enumerated in their
/// order, each once, however close together they are.
template <class Walker>
class BoundaryIndex {
 public:
  using Mesh = typename Walker::Mesh;

  /// Builds the hierarchy, in parallel. The mesh must outlive it. Throws Error where Embree fails.
  explicit BoundaryIndex(const Mesh& mesh);
  ~BoundaryIndex();
  BoundaryIndex(BoundaryIndex&&) noexcept;
  BoundaryIndex& operator=(BoundaryIndex&&) noexcept;

  /// The first entries of the ray, or the next ones after `previous`.
  EntryList next_entries(const Walker& walker, const ShearedFrame& frame,
                         const Entry* previous = nullptr) const;

  /// The first entries of sixteen rays together: faster where they are near each other in space.
  /// None for what is no valid ray.
  void first_entries(const FrameLanes& frames, std::span<EntryList, FrameLanes::kRays> found) const;

 private:
  struct Implementation;
  const Mesh* mesh_;
  std::unique_ptr<Implementation> implementation_;
};

/// A ray's entries one by one, fetched in lists. The referenced objects must outlive it.
template <class Walker>
class Entries {
 public:
  /// The first entry; nothing where there is none.
  std::optional<Entry> first(const BoundaryIndex<Walker>& boundary, const Walker& walker,
                             const ShearedFrame& frame) {
    list_ = boundary.next_entries(walker, frame);
    at_ = 0;
    return current();
  }
  /// The same where the list is fetched by BoundaryIndex::first_entries() into list().
  std::optional<Entry> first() {
    at_ = 0;
    return current();
  }
  EntryList& list() { return list_; }
  /// The entry after that. Requires that there was one.
  std::optional<Entry> next(const BoundaryIndex<Walker>& boundary, const Walker& walker,
                            const ShearedFrame& frame) {
    if (at_ + 1 == list_.size && list_.more) {
      const Entry previous = list_.entries[at_];
      list_ = boundary.next_entries(walker, frame, &previous);
      at_ = 0;
      return current();
    }
    ++at_;
    return current();
  }

 private:
  std::optional<Entry> current() const {
    if (at_ >= list_.size) return std::nullopt;
    return list_.entries[at_];
  }

  EntryList list_;
  std::uint32_t at_ = 0;
};

extern template class BoundaryIndex<TetWalker>;
extern template class BoundaryIndex<GridWalker>;
extern template class BoundaryIndex<HybridGridWalker>;
extern template class BoundaryIndex<PluckerGridWalker>;
extern template class BoundaryIndex<CellWalker>;

}  // namespace plume
