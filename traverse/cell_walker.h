/// Walking cells of any kind, convex or not, by the crossings of their faces: the plain scalar
/// form.
///
/// Triangles are plane, quadrilaterals bilinear patches, other polygons fans around their centre
/// (loop_crossings.h). Where a cell is crossed more than once, its crossings are sorted and paired
/// (pair_crossings.h). On a vertex, an edge or in the plane of a face the ray is taken as moved a
/// little (sheared_frame.h).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "plume/mesh/walkable_cells.h"
#include "plume/traverse/loop_crossings.h"
#include "plume/traverse/pair_crossings.h"

namespace plume {

class CellWalker {
 public:
  using Mesh = WalkableCells;
  using Boundary = BoundaryFace;

  CellWalker(const WalkableCells& mesh, const ShearedFrame& frame) : mesh_(mesh), frame_(frame) {}

  /// Calls visit(place, rank) for each way in through a boundary face.
  template <class Visit>
  void ways_in(const Boundary& boundary, const Visit& visit) const {
    for_each_crossing_of(boundary.face, [&](const LoopCrossing& crossing) {
      if (crossing.direction * frame_.sign() < 0)
        visit(measure(sheared_loop(boundary.face), crossing), crossing.rank);
    });
  }

  void enter(const Boundary& boundary, std::uint32_t rank) {
    cell_ = boundary.cell;
    face_ = boundary.face;
    rank_ = rank;
    entry_.reset();
  }

  std::uint32_t cell() const { return cell_; }
  /// The face by which the ray came into the cell, and which of its crossings that was.
  std::uint32_t face() const { return face_; }
  std::uint32_t rank() const { return rank_; }

  std::optional<Crossing> leave() {
    decided_.clear();
    std::size_t exit = 0;
    for (const std::uint32_t face : mesh_.faces_of(cell_)) {
      if (entry_ && face == face_) {
        decided_.push_back({*entry_, face, false});
        continue;
      }
      // Loops are seen from outside of their owner.
      const int outwards = mesh_.face_sides[face].owner == cell_ ? frame_.sign() : -frame_.sign();
      for_each_crossing_of(face, [&](const LoopCrossing& crossing) {
        if (crossing.direction * outwards > 0) exit = decided_.size();
        decided_.push_back({crossing, face, crossing.direction * outwards > 0});
      });
    }
    if (decided_.size() == 2) {
      const Decided& only = decided_[exit];
      entry_.reset();
      if (decided_[0].face != decided_[1].face) entry_ = only.crossing;
      return left_through(only.face, only.crossing.rank,
                          measure(sheared_loop(only.face), only.crossing));
    }
    entry_.reset();
    crossings_.clear();
    for (const Decided& d : decided_)
      crossings_.push_back(
          {measure(sheared_loop(d.face), d.crossing), d.face, d.crossing.rank, d.out});
    const auto found = exit_for(crossings_.data(), crossings_.size(), face_, rank_, frame_.sign());
    if (!found) return std::nullopt;
    return left_through(found->face, found->rank, found->place);
  }

  bool advance() {
    const auto& sides = mesh_.face_sides[face_];
    cell_ = sides.owner == cell_ ? sides.neighbor : sides.owner;
    return cell_ != kNone;
  }

 private:
  struct Decided {
    LoopCrossing crossing;
    std::uint32_t face;
    bool out;
  };

  template <class Visit>
  void for_each_crossing_of(std::uint32_t face, const Visit& visit) const {
    const auto loop = mesh_.loop(face);
    LoopSides sides;
    ShearedPoint from = frame_(mesh_.points[loop.back()]);
    for (const std::uint32_t id : loop) {
      const ShearedPoint to = frame_(mesh_.points[id]);
      sides.add_edge(from, to);
      from = to;
    }
    for_each_crossing(
        sides, loop.size(), [&] { return sheared_loop(face); }, visit);
  }

  // Valid until the next call.
  std::span<const ShearedPoint> sheared_loop(std::uint32_t face) const {
    const auto loop = mesh_.loop(face);
    if (points_.size() < loop.size()) points_.resize(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i) points_[i] = frame_(mesh_.points[loop[i]]);
    return {points_.data(), loop.size()};
  }

  Crossing left_through(std::uint32_t face, std::uint32_t rank, const Crossing& place) {
    face_ = face;
    rank_ = rank;
    return place;
  }

  const WalkableCells& mesh_;
  const ShearedFrame& frame_;
  std::uint32_t cell_ = kNone;
  std::uint32_t face_ = 0;
  std::uint32_t rank_ = 0;
  std::optional<LoopCrossing> entry_;  // all that the face has, where the cell before told
  std::vector<Decided> decided_;
  mutable std::vector<ShearedPoint> points_ = std::vector<ShearedPoint>(8);
  std::vector<CellCrossing> crossings_;
};

}  // namespace plume
