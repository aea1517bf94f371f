/// The rays that walkers are timed on: pictures' rays, their first hits found beforehand.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "plume/tests/bench/bench_meshes.h"
#include "plume/traverse/boundary.h"
#include "plume/traverse/ray.h"

namespace plume::bench {

/// One way of a ray through the mesh, from boundary to boundary. A mesh that is not convex has
/// several for one ray; each is walked by itself.
struct Passage {
  std::uint32_t ray;  ///< number in BenchView::rays
  Entry entry;
};

struct BenchView {
  std::string name;
  /// Only rays that meet the mesh, in the order of a Z-curve over the picture: neighbours stay
  /// together, whether a walker takes them one by one or in packets.
  std::vector<Ray> rays;
  std::vector<Passage> passages;
  /// Of grids: where each passage comes in if faces are two triangles.
  std::vector<Entry> triangle_entries;
  /// Passages left out as not all walkers have them: a twisted face at the boundary may be crossed
  /// as a bilinear patch and not as two triangles, and is missed by the thesis' hybrid where it is
  /// grazed.
  std::size_t left_out = 0;

  /// Where a walker comes in.
  template <class Walker>
  const Entry& entry(std::size_t passage) const {
    if constexpr (std::is_same_v<Walker, PluckerGridWalker>)
      return triangle_entries[passage];
    else
      return passages[passage].entry;
  }
  /// Takes passages out, given by their numbers in ascending order.
  void leave_out(std::span<const std::uint32_t> passages);
};

/// Four perspective views fitted to the mesh, as the thesis has them (section 6.3.6): along +x, +y
/// and +z, and the "typical" one along (-1, -1, -1), each turned by an azimuth of 3 and an
/// elevation of 2 degrees so that no ray runs along an axis exactly. Each `resolution` pixels wide
/// and high.
///
/// Of the picture's tiles of 32 x 32 pixels, one in `tiles` is taken: less to walk, and rays that
/// are as near to each other as in the whole picture.
std::vector<BenchView> make_views(const BenchMesh& mesh, int resolution, std::uint64_t tiles = 1);

/// One view of given rays. For TetWalker, GridWalker and CellWalker.
template <class Walker>
BenchView make_view(const BenchMesh& mesh, const BoundaryIndex<Walker>& boundary, std::string name,
                    const std::vector<Ray>& rays);

}  // namespace plume::bench
