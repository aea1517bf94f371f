/// Walking the hexahedra of a curvilinear grid: the plain scalar form.
///
/// Which crossings a face has follows from its four corners alone, whether it is planar, twisted or
/// collapsed (quad_crossings.h); three ways to see a face can be chosen from (grid_faces.h). Where
/// a cell is crossed more than once, its crossings are sorted and paired (pair_crossings.h). On a
/// vertex, an edge or in the plane of a face the ray is taken as moved a little (sheared_frame.h).
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "plume/mesh/walkable_grid.h"
#include "plume/traverse/grid_faces.h"
#include "plume/traverse/hexahedron_windings.h"
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
    cell_step_ = {1, ni - 1, (ni - 1) * (mesh.dimensions[1] - 1)};
  }

  /// Calls visit(place, rank) for each way in through a boundary face.
  template <class Visit>
  void ways_in(const Boundary& boundary, const Visit& visit) const {
    const auto index = mesh_.cell_index(boundary.cell);
    std::array<ShearedPoint, 4> p;
    const Quad quad = corners_of(mesh_.first_point(index), boundary.face, p);
    const bool planar = is_planar(index, boundary.face);
    const QuadCrossings crossings = Faces::crossings(quad, winding(quad), planar);
    for (std::uint32_t rank = 0; rank < 2; ++rank)
      if (outwards(boundary.face) * crossings.direction[rank] < 0)
        visit(Faces::measure(quad, crossings, static_cast<int>(rank), planar), rank);
  }

  void enter(const Boundary& boundary, std::uint32_t rank) {
    cell_ = boundary.cell;
    index_ = mesh_.cell_index(cell_);
    first_ = mesh_.first_point(index_);
    face_ = boundary.face;
    rank_ = rank;
  }

  std::uint32_t cell() const { return cell_; }
  /// The face by which the ray came into the cell, and which of its ways in that was.
  std::uint32_t face() const { return face_; }
  std::uint32_t rank() const { return rank_; }

  /// Out of the cell by a face that the ray grazes, and in again by the same.
  struct Excursion {
    Crossing back;            ///< where it comes back into the cell
    std::uint32_t exit_face;  ///< by which it leaves for good
  };

  /// Sets `excursion`, where there is one, if it begins one: in a cell that has one more way in and
  /// one more way out, which has odd winding, and no others.
  std::optional<Crossing> leave(std::optional<Excursion>* excursion = nullptr) {
    std::array<ShearedPoint, 8> corner;
    for (std::size_t c = 0; c < 8; ++c) corner[c] = frame_(mesh_.points[first_ + step_[c]]);
    auto quad = [&](std::size_t face) {
      const auto& loop = kCornerLoop[face];
      return Quad{corner[loop[0]], corner[loop[1]], corner[loop[2]], corner[loop[3]]};
    };

    const HexahedronWindings winding(corner);
    int count = 0;
    std::uint32_t exit_face = 0;
    for (std::uint32_t f = 0; f < 6; ++f) {
      count += std::abs(winding.of(f));
      exit_face = outwards(f) * winding.of(f) > 0 ? f : exit_face;
    }
    const std::uint32_t grazed = first_grazed(winding, quad);
    if (count != 2 || grazed < 6) return leave_one_of_several(winding, quad, grazed, excursion);
    const bool planar = is_planar(index_, exit_face);
    const Quad through = quad(exit_face);
    const QuadCrossings only = Faces::crossings(through, winding.of(exit_face), planar);
    const std::uint32_t rank = only.direction[0] == 0 ? 1 : 0;
    return left_through(exit_face, rank,
                        Faces::measure(through, only, static_cast<int>(rank), planar));
  }

  /// Where the ray crosses a face of the cell of odd winding.
  Crossing crossing_of(std::uint32_t face) const {
    std::array<ShearedPoint, 4> p;
    const Quad quad = corners_of(first_, face, p);
    const bool planar = is_planar(index_, face);
    const QuadCrossings only = Faces::crossings(quad, winding(quad), planar);
    return Faces::measure(quad, only, only.direction[0] == 0 ? 1 : 0, planar);
  }

  bool advance() {
    // As WalkableGrid::neighbor(), without finding the cell's place in the grid anew.
    const std::size_t axis = face_ / 2;
    const bool up = face_ % 2 == 1;
    if (up ? index_[axis] + 2 == mesh_.dimensions[axis] : index_[axis] == 0) return false;
    const std::uint32_t one = up ? 1u : ~0u;
    index_[axis] += one;
    cell_ += one * cell_step_[axis];
    first_ += one * step_[std::size_t{1} << axis];
    face_ ^= 1;  // the face behind -i is its neighbour's +i
    return mesh_.hidden.empty() || !mesh_.hidden[cell_];
  }

 private:
  Quad corners_of(std::uint32_t first_point, std::uint32_t face,
                  std::array<ShearedPoint, 4>& corners) const {
    for (std::size_t i = 0; i < 4; ++i)
      corners[i] = frame_(mesh_.points[first_point + step_[kCornerLoop[face][i]]]);
    return {corners[0], corners[1], corners[2], corners[3]};
  }

  // The first face that is crossed although its winding is 0, or 6.
  template <class QuadOf>
  std::uint32_t first_grazed(const HexahedronWindings& winding, const QuadOf& quad) const {
    if (!Faces::kGrazed || (Faces::kAsksIfPlanar && !mesh_.twisted.holds(index_))) return 6;
    std::uint32_t f = 0;
    while (f < 6 && !(winding.of(f) == 0 && winding.may_be_crossed(f) &&
                      Faces::crossings(quad(f), 0, is_planar(index_, f)).grazed()))
      ++f;
    return f;
  }

  template <class QuadOf>
  std::optional<Crossing> leave_one_of_several(const HexahedronWindings& winding,
                                               const QuadOf& quad, std::uint32_t grazed,
                                               std::optional<Excursion>* excursion) {
    std::array<CellCrossing, 12> crossings;
    std::size_t size = 0;
    for (std::uint32_t f = 0; f < 6; ++f) {
      if (!winding.may_be_crossed(f) || (winding.of(f) == 0 && f < grazed)) continue;
      const bool planar = is_planar(index_, f);
      const QuadCrossings of_face = Faces::crossings(quad(f), winding.of(f), planar);
      for (std::uint32_t rank = 0; rank < 2; ++rank)
        if (of_face.direction[rank] != 0)
          crossings[size++] = {Faces::measure(quad(f), of_face, static_cast<int>(rank), planar), f,
                               rank, outwards(f) * of_face.direction[rank] > 0};
    }
    const auto exit = exit_for(crossings.data(), size, face_, rank_, frame_.sign());
    if (!exit) return std::nullopt;
    if (excursion != nullptr && size == 4)
      for (std::size_t in = 0; in < 2; ++in) {
        const CellCrossing &back = crossings[in], &last = crossings[in + 2];
        if (back.face == exit->face && back.face != face_ && last.face != face_)
          *excursion = Excursion{back.place, last.face};
      }
    return left_through(exit->face, exit->rank, exit->place);
  }

  // 1 if a crossing in the direction of a face's loop leads out of the cell, -1 if in.
  int outwards(std::uint32_t face) const {
    return (face % 2 == 1) != mesh_.left_handed ? frame_.sign() : -frame_.sign();
  }

  bool is_planar(const std::array<std::uint32_t, 3>& index, std::uint32_t face) const {
    return Faces::kAsksIfPlanar && mesh_.is_planar(index, face);
  }

  Crossing left_through(std::uint32_t face, std::uint32_t rank, const Crossing& place) {
    face_ = face;
    rank_ = rank;
    return place;
  }

  const WalkableGrid& mesh_;
  const ShearedFrame& frame_;
  std::array<std::uint32_t, 8> step_;       // from a cell's first point to its corners
  std::array<std::uint32_t, 3> cell_step_;  // from a cell to the next along each axis
  std::uint32_t cell_ = kNone;
  std::array<std::uint32_t, 3> index_{0, 0, 0};
  std::uint32_t first_ = 0;
  std::uint32_t face_ = 0;
  std::uint32_t rank_ = 0;
};

/// Planar faces take the cheap path, twisted ones the patch with all its crossings.
using GridWalker = BasicGridWalker<PlanarOrPatchFaces>;
/// The thesis' hybrid, and its pure Plücker form, to compare with.
using HybridGridWalker = BasicGridWalker<PatchFaces>;
using PluckerGridWalker = BasicGridWalker<TriangleFaces>;

}  // namespace plume
