/// What walks through a mesh are worth, by the oracles.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "atlas_walk.h"
#include "plume/tests/reference/line_lengths.h"
#include "scenes.h"

namespace plume::atlas {

/// Rays by what is wrong with them; a ray may count in several columns.
struct Tally {
  std::uint64_t rays = 0;
  std::uint64_t lost = 0;         ///< no way out of a cell, by the method's own account
  std::uint64_t looping = 0;      ///< stopped by a limit on steps
  std::uint64_t gaps = 0;         ///< the spans cover less of the ray than there is of the mesh
  std::uint64_t overlaps = 0;     ///< more than there is, or something twice, or they go back
  std::uint64_t wrong_cells = 0;  ///< of some cell they hold more than there is of it
  std::uint64_t failed = 0;       ///< any of these
  /// The farthest that the covered length is from the chord, in diagonals of the bounds, over rays
  /// whose chord rounding does not change by more than 2e-6; lost rays included.
  double chord_error = 0;
  /// The same of the integral of the scalar, in diagonals times the scalar's range; not where cells
  /// overlap, as lengths are not where scalars are.
  double integral_error = 0;

  void add(const Tally& other);
};

/// The truth about the rays of a scene's mesh, found once for all methods.
///
/// Rounding of the vertices, of the ray and of shearing moves the ray against the mesh by up to
/// 5e-7 of the mesh's diagonal (tests/traverse/twisted_faces_test.cpp). What some ray within that
/// distance sees is therefore right, and on top of it a millionth of the diagonal. The truth is
/// that of nine such rays. Where a method says otherwise of the whole ray, a hundred more are
/// asked; where it holds more of a cell than all nine see, every stretch that it takes for the
/// inside of that cell has to be there, or as near (tests/reference/cell_distance.h): a ray along
/// an edge is within rounding of all cells around it, however thin. Holding less of a cell is a
/// gap, or more of another one.
class Judge {
 public:
  Judge(const SceneMesh& mesh, Oracle oracle);

  Tally operator()(const MethodWalks& method) const;
  bool knows_cells() const { return oracle_ == Oracle::cells; }

 private:
  struct Range {
    double low = 0, high = 0;
    bool holds(double x, double slack) const { return x >= low - slack && x <= high + slack; }
    double width() const { return high - low; }
    void take(double x);
  };
  struct Truth {
    std::vector<std::uint32_t> near;  // cells that the ray comes near
    std::vector<Range> cells;
    Range total;
    double length = 0, integral = 0;  // of the line itself
    bool known = false;               // rounding changes neither of the two by much
  };
  using Loops = std::vector<reference::CellLoops>;

  std::vector<Truth> truths_of(const Loops& loops) const;
  Truth truth_of_box(const Ray& ray) const;
  std::vector<std::uint32_t> cells_near(const Loops& loops, const Ray& ray) const;
  bool is_beside(const Span& span, const Ray& ray, const reference::CellLoops& cell,
                 bool sampled) const;
  bool some_ray_sees(double length, const Loops& loops, const Ray& ray, Range range,
                     double slack) const;

  const SceneMesh& mesh_;
  Oracle oracle_;
  double diagonal_;
  std::map<Surface, Loops> loops_;
  std::map<Surface, std::vector<Truth>> truths_;
};

}  // namespace plume::atlas
