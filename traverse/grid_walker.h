/// Walking the hexahedra of a curvilinear grid: the plain scalar form.
///
/// Which crossings a face has follows from its four corners alone, whether it is planar, twisted or
/// collapsed (quad_crossings.h); three ways to see a face can be chosen from (grid_faces.h). Where
/// a cell is crossed more than once, its crossings are sorted and paired (pair_crossings.h). On a
/// vertex, an edge or in the plane of a face the ray is taken as moved a little (sheared_frame.h).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "plume/mesh/walkable_grid.h"
#include "plume/traverse/grid_faces.h"
#include "plume/traverse/pair_crossings.h"

namespace plume {

/// `Faces` is one of grid_faces.h.
template <class Faces>
class BasicGridWalker {
 public:
  using Mesh = WalkableGrid;
  using Boundary = BoundaryFace;

  BasicGridWalker(const WalkableGrid& mesh, const ShearedFrame& frame)
      : mesh_(mesh), frame_(frame) {
    const std::uint32_t ni = mesh.dimensions[0], nij = ni * mesh.dimensions[1];
    step_ = {0, 1, ni, 1 + ni, nij, 1 + nij, ni + nij, 1 + ni + nij};
  }

  /// Calls visit(place, rank) for each way in through a boundary face.
  template <class Visit>
  void ways_in(const Boundary& boundary, const Visit& visit) const {
    const std::uint32_t first = mesh_.first_point(boundary.cell);
    std::array<ShearedPoint, 4> p;
    for (std::size_t i = 0; i < 4; ++i)
      p[i] = frame_(mesh_.points[first + step_[kLoop[boundary.face][i]]]);
    const Quad quad{p[0], p[1], p[2], p[3]};
    const bool planar = is_planar(first, boundary.face);
    const QuadCrossings crossings = Faces::crossings(quad, planar);
    for (std::uint32_t rank = 0; rank < 2; ++rank)
      if (outwards(boundary.face) * crossings.direction[rank] < 0)
        visit(Faces::measure(quad, crossings, static_cast<int>(rank), planar), rank);
  }

  void enter(const Boundary& boundary, std::uint32_t rank) {
    cell_ = boundary.cell;
    face_ = boundary.face;
    rank_ = rank;
  }

  std::uint32_t cell() const { return cell_; }

  std::optional<Crossing> leave() {
    const std::uint32_t first = mesh_.first_point(cell_);
    std::array<ShearedPoint, 8> corner;
    unsigned up = 0;
    for (std::size_t c = 0; c < 8; ++c) {
      corner[c] = frame_(mesh_.points[first + step_[c]]);
      up |= static_cast<unsigned>(corner[c].up()) << c;
    }
    auto quad = [&](std::size_t face) {
      const auto& loop = kLoop[face];
      return Quad{corner[loop[0]], corner[loop[1]], corner[loop[2]], corner[loop[3]]};
    };

    std::array<QuadCrossings, 6> faces;
    int count = 0;
    std::uint32_t exit_face = 0, exit_rank = 0;
    for (std::uint32_t f = 0; f < 6; ++f) {
      // All corners on one side of y = 0, as of most faces: no edge crosses it.
      const unsigned own = up & kCorners[f];
      if (own == 0 || own == kCorners[f]) continue;
      faces[f] = Faces::crossings(quad(f), is_planar(first, f));
      for (std::uint32_t rank = 0; rank < 2; ++rank) {
        if (faces[f].direction[rank] == 0) continue;
        ++count;
        if (outwards(f) * faces[f].direction[rank] < 0) continue;
        exit_face = f;
        exit_rank = rank;
      }
    }
    auto measure = [&](std::uint32_t f, std::uint32_t rank) {
      return Faces::measure(quad(f), faces[f], static_cast<int>(rank), is_planar(first, f));
    };
    if (count == 2) return left_through(exit_face, exit_rank, measure(exit_face, exit_rank));
    std::array<CellCrossing, 12> crossings;
    std::size_t size = 0;
    for (std::uint32_t f = 0; f < 6; ++f)
      for (std::uint32_t rank = 0; rank < 2; ++rank)
        if (faces[f].direction[rank] != 0)
          crossings[size++] = {measure(f, rank), f, rank,
                               outwards(f) * faces[f].direction[rank] > 0};
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
  // The same corners as bits.
  static constexpr std::uint8_t kCorners[6] = {0x55, 0xAA, 0x33, 0xCC, 0x0F, 0xF0};

  // 1 if a crossing in the direction of the loop above leads out of the cell, -1 if in.
  int outwards(std::uint32_t face) const {
    return (face % 2 == 1) != mesh_.left_handed ? frame_.sign() : -frame_.sign();
  }

  bool is_planar(std::uint32_t first_point, std::uint32_t face) const {
    return Faces::kAsksIfPlanar &&
           mesh_.is_planar(first_point + (face % 2 == 1 ? step_[1u << face / 2] : 0), face / 2);
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

/// Planar faces take the cheap path, twisted ones the patch with all its crossings.
using GridWalker = BasicGridWalker<PlanarOrPatchFaces>;
/// The thesis' hybrid, and its pure Plücker form, to compare with.
using HybridGridWalker = BasicGridWalker<PatchFaces>;
using PluckerGridWalker = BasicGridWalker<TriangleFaces>;

}  // namespace plume
