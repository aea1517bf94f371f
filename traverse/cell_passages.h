/// How a ray passes through one cell of any kind, by who has not walked to it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "plume/mesh/corner_cells.h"
#include "plume/traverse/cell_walker.h"
#include "plume/traverse/grid_faces.h"
#include "plume/traverse/grid_walker.h"
#include "plume/traverse/hexahedron_windings.h"
#include "plume/traverse/loop_crossings.h"
#include "plume/traverse/pair_crossings.h"

namespace plume {

/// Calls visit(const CellCrossing&) for the crossings of a face of a cell, decided and measured by
/// GridWalker's operations: the same bits. `corner` are the cell's, 0 to 7, where they are asked.
template <class CornerAt, class Visit>
void for_each_crossing_of(const WalkableGrid& mesh, int sign, std::uint32_t cell,
                          std::uint32_t face, const CornerAt& corner, const Visit& visit) {
  const auto& loop = kCornerLoop[face];
  const ShearedPoint &a = corner(loop[0]), &b = corner(loop[1]);
  const ShearedPoint &c = corner(loop[2]), &d = corner(loop[3]);
  const Quad quad{a, b, c, d};
  const bool planar = mesh.is_planar(mesh.cell_index(cell), face);
  const int outwards = (face % 2 == 1) != mesh.left_handed ? sign : -sign;
  const QuadCrossings of_face = PlanarOrPatchFaces::crossings(quad, winding(quad), planar);
  for (std::uint32_t rank = 0; rank < 2; ++rank)
    if (of_face.direction[rank] != 0)
      visit(CellCrossing{PlanarOrPatchFaces::measure(quad, of_face, static_cast<int>(rank), planar),
                         face, rank, outwards * of_face.direction[rank] > 0});
}

/// The same of a face of a cell of any kind, by CellWalker's operations. `points` is for use here.
template <class Visit>
void for_each_crossing_of(const WalkableCells& mesh, const ShearedFrame& frame, std::uint32_t cell,
                          std::uint32_t face, std::vector<ShearedPoint>& points,
                          const Visit& visit) {
  const auto loop = mesh.loop(face);
  points.resize(loop.size());
  LoopSides sides;
  for (std::size_t i = 0; i < loop.size(); ++i) points[i] = frame(mesh.points[loop[i]]);
  const ShearedPoint* from = &points.back();
  for (const ShearedPoint& to : points) {
    sides.add_edge(*from, to);
    from = &to;
  }
  const std::span<const ShearedPoint> corners(points);
  // Loops are seen from outside of their owner.
  const int outwards = mesh.face_sides[face].owner == cell ? frame.sign() : -frame.sign();
  for_each_crossing(
      sides, loop.size(), [&] { return corners; },
      [&](const LoopCrossing& crossing) {
        visit(CellCrossing{measure(corners, crossing), face, crossing.rank,
                           crossing.direction * outwards > 0});
      });
}

/// Finds the ways of a ray through cells, and through faces at the boundary: for GridWalker and
/// CellWalker.
template <class Walker>
class CellPassages {
 public:
  using Mesh = typename Walker::Mesh;

  explicit CellPassages(const Mesh& mesh) : mesh_(mesh) {}

  /// A way in and the way out that belongs to it, on the cell's faces.
  struct Passage {
    CellCrossing in, out;
  };

  /// All passages through a cell, those that begin first along the ray first. Valid until the next
  /// call.
  std::span<const Passage> through(std::uint32_t cell, const ShearedFrame& frame) {
    crossings_.clear();
    auto add = [&](const CellCrossing& crossing) { crossings_.push_back(crossing); };
    if constexpr (std::is_same_v<Mesh, WalkableGrid>) {
      const std::uint32_t first = mesh_.first_point(cell), ni = mesh_.dimensions[0];
      const std::uint32_t nij = ni * mesh_.dimensions[1];
      std::array<ShearedPoint, 8> corner;
      for (std::uint32_t c = 0; c < 8; ++c)
        corner[c] = frame(mesh_.points[first + (c & 1) + (c >> 1 & 1) * ni + (c >> 2) * nij]);
      const HexahedronWindings winding(corner);
      for (std::uint32_t face = 0; face < 6; ++face)
        if (winding.may_be_crossed(face))
          for_each_crossing_of(
              mesh_, frame.sign(), cell, face,
              [&](std::size_t c) -> const ShearedPoint& { return corner[c]; }, add);
    } else {
      for (const std::uint32_t face : mesh_.faces_of(cell))
        for_each_crossing_of(mesh_, frame, cell, face, points_, add);
    }
    passages_.clear();
    // Sorts them; none is that one.
    exit_for(crossings_.data(), crossings_.size(), kNone, 0, frame.sign());
    const std::size_t ways_in = crossings_.size() / 2;
    for (std::size_t i = 0; i < ways_in; ++i)
      passages_.push_back({crossings_[i], crossings_[ways_in + i]});
    return passages_;
  }

  /// Calls visit(const CellCrossing&) for the crossings of a face at the boundary.
  template <class Visit>
  void across_boundary(const BoundaryFace& face, const ShearedFrame& frame, const Visit& visit) {
    if constexpr (std::is_same_v<Mesh, WalkableGrid>) {
      const std::uint32_t first = mesh_.first_point(face.cell), ni = mesh_.dimensions[0];
      const std::uint32_t nij = ni * mesh_.dimensions[1];
      std::array<ShearedPoint, 8> corner;
      for (const std::uint32_t c : kCornerLoop[face.face])
        corner[c] = frame(mesh_.points[first + (c & 1) + (c >> 1 & 1) * ni + (c >> 2) * nij]);
      for_each_crossing_of(
          mesh_, frame.sign(), face.cell, face.face,
          [&](std::size_t c) -> const ShearedPoint& { return corner[c]; }, visit);
    } else {
      for_each_crossing_of(mesh_, frame, face.cell, face.face, points_, visit);
    }
  }

  /// A face of a cell as the cell behind it knows it; kNone at the boundary.
  BoundaryFace other_side(std::uint32_t cell, std::uint32_t face) const {
    if constexpr (std::is_same_v<Mesh, WalkableGrid>) {
      return {mesh_.neighbor(cell, face), face ^ 1};
    } else {
      const auto& sides = mesh_.face_sides[face];
      return {sides.owner == cell ? sides.neighbor : sides.owner, face};
    }
  }

  /// Whether the ray, walked back from a way into a cell at `z_in`, has nowhere a place that is not
  /// before it, until it has gone back by more than `distance` in z or has reached the boundary.
  /// `reversed` is the frame of the ray that runs the other way: the same bits but for its sign.
  bool comes_from_before(std::uint32_t cell, std::uint32_t face, std::uint32_t rank, double z_in,
                         const ShearedFrame& reversed, double distance) const {
    constexpr int kMost = 256;
    const BoundaryFace behind = other_side(cell, face);
    if (behind.cell == kNone) return true;
    Walker back(mesh_, reversed);
    back.enter(behind, rank);
    for (int step = 0; step < kMost; ++step) {
      const auto place = back.leave();
      if (!place) return false;
      const double forward = (z_in - place->z) * reversed.sign();
      if (forward > 0) return false;
      if (forward < -distance || !back.advance()) return true;
    }
    return false;
  }

 private:
  const Mesh& mesh_;
  std::vector<CellCrossing> crossings_;
  std::vector<Passage> passages_;
  std::vector<ShearedPoint> points_;
};

}  // namespace plume
