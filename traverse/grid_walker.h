/// Walking the hexahedra of a curvilinear grid: the plain scalar form.
///
/// The winding of each face follows from its four edges, whether it is planar, twisted or
/// collapsed. On a vertex, an edge or in the plane of a face the ray is taken as moved a little
/// (sheared_frame.h). A twisted face that the ray grazes in and out again (winding 0) counts as
/// missed: the sliver behind it is seen as part of the cell in front.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "plume/mesh/walkable_grid.h"
#include "plume/traverse/pair_crossings.h"

namespace plume {

class GridWalker {
 public:
  using Mesh = WalkableGrid;
  using Boundary = BoundaryFace;

  GridWalker(const WalkableGrid& mesh, const ShearedFrame& frame) : mesh_(mesh), frame_(frame) {
    const std::uint32_t ni = mesh.dimensions[0], nij = ni * mesh.dimensions[1];
    step_ = {0, 1, ni, 1 + ni, nij, 1 + nij, ni + nij, 1 + ni + nij};
  }

  int boundary_winding(const Boundary& boundary) const {
    const auto loop = face_loop(boundary);
    return outward(boundary.face, winding(loop));
  }

  Crossing measure_boundary(const Boundary& boundary, int outward_winding) const {
    const auto loop = face_loop(boundary);
    return measure_patch(loop[0], loop[1], loop[2], loop[3],
                         outward(boundary.face, outward_winding));
  }

  void enter(const Boundary& boundary, std::uint32_t rank) {
    cell_ = boundary.cell;
    face_ = boundary.face;
    rank_ = rank;
  }

  std::uint32_t cell() const { return cell_; }
  /// The face by which the ray came into the cell, and which of its ways in that was.
  std::uint32_t face() const { return face_; }
  std::uint32_t rank() const { return rank_; }

  std::optional<Crossing> leave() {
    std::array<ShearedPoint, 8> corner;
    const std::uint32_t first = mesh_.first_point(cell_);
    for (std::size_t c = 0; c < 8; ++c) corner[c] = frame_(mesh_.points[first + step_[c]]);

    std::array<int, 6> ways;  // > 0: that many ways out, < 0: that many in
    int count = 0;
    for (std::size_t f = 0; f < 6; ++f) {
      const auto& loop = kLoop[f];
      ways[f] =
          frame_.sign() *
          outward(static_cast<std::uint32_t>(f),
                  winding({corner[loop[0]], corner[loop[1]], corner[loop[2]], corner[loop[3]]}));
      count += std::abs(ways[f]);
    }
    auto measure = [&](std::uint32_t f) {
      const auto& loop = kLoop[f];
      const int w = outward(f, ways[f] * frame_.sign());
      return measure_patch(corner[loop[0]], corner[loop[1]], corner[loop[2]], corner[loop[3]], w);
    };
    if (count == 2) {
      for (std::uint32_t f = 0; f < 6; ++f)
        if (ways[f] > 0) return left_through(f, 0, measure(f));
      return std::nullopt;
    }
    std::array<CellCrossing, 12> crossings;  // a quadrilateral's winding is at most 2
    std::size_t size = 0;
    for (std::uint32_t f = 0; f < 6; ++f)
      for (std::uint32_t rank = 0; rank < static_cast<std::uint32_t>(std::abs(ways[f])); ++rank)
        crossings[size++] = {measure(f), f, rank, ways[f] > 0};
    const auto exit = exit_for(crossings.data(), size, face_, rank_, frame_.sign());
    if (!exit) return std::nullopt;
    return left_through(exit->face, exit->rank, exit->place);
  }

  bool advance() {
    cell_ = mesh_.neighbor(cell_, face_);
    face_ ^= 1;  // the face behind -i is its neighbour's +i
    return cell_ != kNone;
  }

 private:
  // Corners of the faces -i, +i, -j, +j, -k, +k, corner (a, b, c) being a + 2b + 4c. Both cells at
  // a face go around it from the same corner in the same direction, so they see the same numbers;
  // from outside of a right-handed cell that is counterclockwise for +i, +j and +k.
  static constexpr std::uint8_t kLoop[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 4, 5, 1},
                                               {2, 6, 7, 3}, {0, 1, 3, 2}, {4, 5, 7, 6}};

  static int winding(const std::array<ShearedPoint, 4>& p) {
    return crossing(p[0], p[1]) + crossing(p[1], p[2]) + crossing(p[2], p[3]) +
           crossing(p[3], p[0]);
  }

  // From the winding of the loop above to that seen from outside, and back.
  int outward(std::uint32_t face, int w) const {
    return (face % 2 == 1) != mesh_.left_handed ? w : -w;
  }

  std::array<ShearedPoint, 4> face_loop(const Boundary& boundary) const {
    const std::uint32_t first = mesh_.first_point(boundary.cell);
    std::array<ShearedPoint, 4> loop;
    for (std::size_t i = 0; i < 4; ++i)
      loop[i] = frame_(mesh_.points[first + step_[kLoop[boundary.face][i]]]);
    return loop;
  }

  Crossing left_through(std::uint32_t face, std::uint32_t rank, const Crossing& place) {
    face_ = face;
    rank_ = rank;
    return place;
  }

  const WalkableGrid& mesh_;
  const ShearedFrame& frame_;
  std::array<std::uint32_t, 8> step_;
  std::uint32_t cell_ = kNone;
  std::uint32_t face_ = 0;
  std::uint32_t rank_ = 0;
};

}  // namespace plume
