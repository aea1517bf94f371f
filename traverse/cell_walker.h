/// Walking cells of any kind, convex or not, by the windings of their faces: the plain scalar form.
///
/// Triangles are measured by their edges' products, quadrilaterals as bilinear patches, other
/// polygons as fans around their centre. On a vertex, an edge or in the plane of a face the ray is
/// taken as moved a little (sheared_frame.h).
#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "plume/mesh/walkable_cells.h"
#include "plume/traverse/pair_crossings.h"

namespace plume {

class CellWalker {
 public:
  using Mesh = WalkableCells;
  using Boundary = BoundaryFace;

  CellWalker(const WalkableCells& mesh, const ShearedFrame& frame) : mesh_(mesh), frame_(frame) {}

  int boundary_winding(const Boundary& boundary) const { return winding(boundary.face); }

  Crossing measure_boundary(const Boundary& boundary, int outward_winding) const {
    return measure(boundary.face, outward_winding);
  }

  void enter(const Boundary& boundary, std::uint32_t rank) {
    cell_ = boundary.cell;
    face_ = boundary.face;
    rank_ = rank;
  }

  std::uint32_t cell() const { return cell_; }

  std::optional<Crossing> leave() {
    const auto faces = mesh_.faces_of(cell_);
    ways_.clear();
    int count = 0;
    const std::uint32_t* exit_face = nullptr;
    for (const std::uint32_t& face : faces) {
      const bool owner = mesh_.face_sides[face].owner == cell_;
      ways_.push_back(frame_.sign() * (owner ? 1 : -1) * winding(face));
      count += std::abs(ways_.back());
      if (ways_.back() > 0) exit_face = &face;
    }
    auto measure_way = [&](std::uint32_t face, int ways) {
      const bool owner = mesh_.face_sides[face].owner == cell_;
      return measure(face, ways * frame_.sign() * (owner ? 1 : -1));
    };
    if (count == 2 && exit_face != nullptr)
      return left_through(*exit_face, 0, measure_way(*exit_face, 1));
    crossings_.clear();
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::uint32_t rank = 0; rank < static_cast<std::uint32_t>(std::abs(ways_[f])); ++rank)
        crossings_.push_back({measure_way(faces[f], ways_[f]), faces[f], rank, ways_[f] > 0});
    const auto exit = exit_for(crossings_.data(), crossings_.size(), face_, rank_, frame_.sign());
    if (!exit) return std::nullopt;
    return left_through(exit->face, exit->rank, exit->place);
  }

  bool advance() {
    const auto& sides = mesh_.face_sides[face_];
    cell_ = sides.owner == cell_ ? sides.neighbor : sides.owner;
    return cell_ != kNone;
  }

 private:
  // The winding of a face seen from outside of its owner.
  int winding(std::uint32_t face) const {
    const auto loop = mesh_.loop(face);
    ShearedPoint from = frame_(mesh_.points[loop.back()]);
    int sum = 0;
    for (const std::uint32_t id : loop) {
      const ShearedPoint to = frame_(mesh_.points[id]);
      sum += crossing(from, to);
      from = to;
    }
    return sum;
  }

  Crossing measure(std::uint32_t face, int face_winding) const {
    thread_local std::vector<ShearedPoint> p;
    p.clear();
    for (const std::uint32_t id : mesh_.loop(face)) p.push_back(frame_(mesh_.points[id]));
    if (p.size() == 3) return measure_triangle(p[0], p[1], p[2]);
    if (p.size() == 4) return measure_patch(p[0], p[1], p[2], p[3], face_winding);
    return measure_polygon(p, face_winding);
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
  std::vector<int> ways_;
  std::vector<CellCrossing> crossings_;
};

}  // namespace plume
