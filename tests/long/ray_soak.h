/// Rays by the million: none lost, packets as their scalar twin, forth as back.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "plume/mesh/mesh.h"

namespace plume::test {

/// Single precision resolves 6e-8 of a mesh whose diagonal is up to 3.5 in the local frame;
/// shearing a point takes three operations, at either end of the chord.
inline constexpr double kTwinSlack = 2e-6;
/// Packets measure in single precision, too.
inline constexpr double kPacketSlack = 4e-6;

/// What rays came to.
struct SoakTally {
  std::uint64_t rays = 0;
  /// Rays without a direction: from a point to another at the same place.
  std::uint64_t aimless = 0;
  std::uint64_t passages = 0;  ///< ways from boundary to boundary
  std::uint64_t cells = 0;
  /// Rays that found no way out.
  std::uint64_t lost = 0;
  /// Rays whose passages contradict what is known otherwise: trace() and the walker alone do not
  /// meet the same cells, segments run backwards or overlap; the first ways in are other ones, or
  /// elsewhere, where sixteen rays are looked at together; or, of one ray in 16 through a small
  /// mesh, the ways in or out are not as many as those of all boundary faces, tried one by one.
  std::uint64_t contradictions = 0;
  /// Passages in which packets meet other cells than the twin, or in another order.
  std::uint64_t different = 0;
  /// Of one ray in 8, those that meet other cells, or in another order, when turned around.
  std::uint64_t one_way = 0;
  /// Rays, and passages of packets, that are longer than the bounds' diagonal; where the mesh fills
  /// its bounds, those whose segments do not sum up to the chord (reference::box_chord_range).
  /// Within kTwinSlack or kPacketSlack of the diagonal.
  std::uint64_t off_length = 0;
  /// The farthest that a sum is from the chord, in diagonals, of rays that do not graze the box:
  /// whose chord stays above zero, and changes by less than 2e-5, when its sides move by 2e-6. The
  /// twin's sums are in double, those of packets in single precision.
  double worst_twin = 0, worst_packets = 0;
  /// The first failure, in one line that tells how to find it again; empty where there is none.
  std::string problem;

  std::uint64_t failures() const {
    return lost + contradictions + different + one_way + off_length;
  }
  void add(const SoakTally& other);
};

/// A mesh made ready for it. May be read by several threads.
class SoakMesh {
 public:
  virtual ~SoakMesh() = default;
  /// Walks `rays` rays of a batch, which is known by `seed` and `batch`: the same ones wherever and
  /// in whatever order batches run.
  virtual SoakTally soak(std::uint64_t seed, std::uint64_t batch, std::uint64_t rays) const = 0;
};

/// By the walker of such a mesh: tetrahedra, a curvilinear grid, other cells, a rectilinear grid.
/// `fills`: the mesh fills its bounds.
std::unique_ptr<SoakMesh> make_soak_mesh(const std::string& name, Mesh mesh, bool fills);
/// Of a rectilinear grid, whose walker has a trace of its own.
std::unique_ptr<SoakMesh> make_rectilinear_soak_mesh(const std::string& name, Mesh mesh);

}  // namespace plume::test
