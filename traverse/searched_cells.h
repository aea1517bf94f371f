/// How rays that look for cells pass through them, and through faces at the boundary.
#pragma once

#include <cstddef>
#include <cstdint>

#include "plume/mesh/cell_clusters.h"
#include "plume/mesh/cell_hierarchy.h"
#include "plume/traverse/cell_passages.h"
#include "plume/traverse/searched_ray.h"
#include "plume/traverse/tet_passage.h"

namespace plume {

/// In the mesh's local frame: closer than this two places may be out of order by rounding.
inline constexpr double kSearchRounding = 0x1p-20;

/// Of tetrahedra. Keeps references.
class TetCells {
 public:
  using Cell = TetCell;
  /// Whether cross_boundary() is called for faces that the ray crosses, once, and no others.
  static constexpr bool kFacesAreCrossed = true;

  TetCells(const WalkableTets& mesh, const CellHierarchy& hierarchy)
      : mesh_(mesh), hierarchy_(hierarchy) {}

  const LocalFrame& frame() const { return mesh_.frame; }
  std::uint32_t number_of(const Cell& cell) const { return cell.cell; }

  /// Calls pass(const CellCrossing& in, const CellCrossing& out, is_clear) for each time the ray
  /// goes through the cell, until that returns false. is_clear() is whether what
  /// comes_from_before() asks is known without a look. False where a pass was, or where the ray
  /// must be walked.
  template <class Pass>
  bool pass_through(const Cell& cell, const ShearedFrame& frame, const Pass& pass) const {
    const TetPassage passage(cell, frame);
    if (passage.ways() == TetPassage::Ways::none) return true;
    if (passage.ways() == TetPassage::Ways::two) return false;
    const auto in = static_cast<std::uint32_t>(passage.in_face());
    const auto out = static_cast<std::uint32_t>(passage.out_face());
    return pass(CellCrossing{passage.in(), in, 0, false}, CellCrossing{passage.out(), out, 0, true},
                [&] {
                  const std::uint32_t behind = mesh_.cells[cell.cell][in].cell;
                  return behind != kNone && !hierarchy_.near_thin(behind) &&
                         passage.enters_clear_of_edges(kClearOfEdges);
                });
  }

  /// Whether the ray goes from one cell right into the other.
  bool joins(const FoundSegment& before, const FoundSegment& after) const {
    return mesh_.cells[before.cell][before.out.face].cell == after.cell &&
           mesh_.cells[after.cell][after.in.face].cell == before.cell;
  }

  /// Whether a walk to the cell has been nowhere that is not before the place where it comes in, if
  /// it has gone forward through all thin cells.
  bool comes_from_before(const FoundSegment& found, const Ray& /*ray*/,
                         const ShearedFrame& frame) const {
    return found.is_clear || plume::comes_from_before(mesh_, frame, found.cell, found.in.face,
                                                      found.z_in, kSearchRounding);
  }

  /// Adds to what is known of the ray that it crosses the face, of that number in the mesh's list,
  /// which winds about it.
  void cross_boundary(std::uint32_t number, const ShearedFrame& frame, SearchedRay& ray) const {
    const TetWalker walker(mesh_, frame);
    const WalkableTets::Boundary& face = mesh_.boundary[number];
    const int winding = walker.boundary_winding(face);
    const Crossing place = walker.measure_boundary(face, winding);
    ray.cross_boundary(frame.t(place.z), place.scalar, winding * frame.sign() < 0);
  }

 private:
  // So far from the edges of the face by which it comes in, a ray has come through a good part of
  // the cell before, if that is not thin.
  static constexpr float kClearOfEdges = 0x1p-14f;

  const WalkableTets& mesh_;
  const CellHierarchy& hierarchy_;
};

/// The same of other cells, for GridWalker and CellWalker. Keeps a reference. One thread's.
template <class Walker>
class AnyCells {
 public:
  using Mesh = typename Walker::Mesh;
  using Cell = std::uint32_t;
  static constexpr bool kFacesAreCrossed = false;

  explicit AnyCells(const Mesh& mesh) : mesh_(mesh), passages_(mesh) {}

  const LocalFrame& frame() const { return mesh_.frame; }
  std::uint32_t number_of(Cell cell) const { return cell; }

  template <class Pass>
  bool pass_through(Cell cell, const ShearedFrame& frame, const Pass& pass) const {
    const auto found = passages_.through(cell, frame);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const CellCrossing &in = found[i].in, &out = found[i].out;
      // In and out, in turns.
      if (i > 0 && (in.place.z - found[i - 1].out.place.z) * frame.sign() < 0) return false;
      if (!pass(in, out, [] { return false; })) return false;
    }
    return true;
  }

  bool joins(const FoundSegment& before, const FoundSegment& after) const {
    const BoundaryFace behind = passages_.other_side(after.cell, after.in.face);
    return behind.cell == before.cell && behind.face == before.out.face &&
           before.out.rank == after.in.rank;
  }

  bool comes_from_before(const FoundSegment& found, const Ray& ray,
                         const ShearedFrame& /*frame*/) const {
    Ray turned = ray;
    for (double& d : turned.direction) d = -d;
    ShearedFrame reversed;
    return reversed.set(turned, mesh_.frame) &&
           passages_.comes_from_before(found.cell, found.in.face, found.in.rank, found.z_in,
                                       reversed, kSearchRounding);
  }

  /// Of any face, whether the ray crosses it or not.
  void cross_boundary(std::uint32_t number, const ShearedFrame& frame, SearchedRay& ray) const {
    passages_.across_boundary(mesh_.boundary[number], frame, [&](const CellCrossing& crossing) {
      ray.cross_boundary(frame.t(crossing.place.z), crossing.place.scalar, !crossing.out);
    });
  }

 private:
  const Mesh& mesh_;
  mutable CellPassages<Walker> passages_;
};

}  // namespace plume
