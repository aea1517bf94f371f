#include "plume/mesh/walkable_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/face_matching.h"

namespace plume {
namespace {

// Sign of the sum of all cells' volumes.
bool is_left_handed(const Mesh& mesh) {
  const CellReader cells(mesh);
  const double volume = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, cells.size(), 4096), 0.0,
      [&](const auto& range, double sum) {
        std::vector<std::uint32_t> sizes, ids;
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          if (cells.hidden(i)) continue;
          cells.faces(i, sizes, ids);
          sum += signed_volume(mesh, sizes, ids);
        }
        return sum;
      },
      std::plus<double>());
  return volume < 0;
}

// Whether two lines, the diagonals of a face, are within kPlanar of each other: all four corners
// are then within half of that of the plane between them, as is the patch, their convex
// combination.
bool is_planar_quad(const WalkablePoint& a, const WalkablePoint& b, const WalkablePoint& c,
                    const WalkablePoint& d) {
  std::array<double, 3> ac, bd, ab;
  for (std::size_t i = 0; i < 3; ++i) {
    ac[i] = static_cast<double>(c.position[i]) - a.position[i];
    bd[i] = static_cast<double>(d.position[i]) - b.position[i];
    ab[i] = static_cast<double>(b.position[i]) - a.position[i];
  }
  const std::array<double, 3> normal{ac[1] * bd[2] - ac[2] * bd[1], ac[2] * bd[0] - ac[0] * bd[2],
                                     ac[0] * bd[1] - ac[1] * bd[0]};
  const double volume = normal[0] * ab[0] + normal[1] * ab[1] + normal[2] * ab[2];
  return std::abs(volume) <= kPlanar * std::hypot(normal[0], normal[1], normal[2]);
}

// The cells from `low` to, but not including, `high` along each axis.
struct IndexRange {
  std::array<std::uint32_t, 3> low{kNone, kNone, kNone}, high{0, 0, 0};

  void add(std::size_t axis, std::uint32_t from, std::uint32_t to) {
    low[axis] = std::min(low[axis], from);
    high[axis] = std::max(high[axis], to);
  }
  friend IndexRange operator+(IndexRange one, const IndexRange& other) {
    for (std::size_t a = 0; a < 3; ++a) one.add(a, other.low[a], other.high[a]);
    return one;
  }
};

// See WalkableGrid::twisted.
CellBox box_of_twisted_faces(const WalkableGrid& grid) {
  const std::array<std::uint32_t, 3>& n = grid.dimensions;
  const std::array<std::uint32_t, 3> step{1, n[0], n[0] * n[1]};
  // Adds the cells at the faces whose lowest corner that point is.
  auto add_faces = [&](std::size_t p, IndexRange& range) {
    const std::array<std::size_t, 3> index{p % n[0], p / n[0] % n[1], p / n[0] / n[1]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
      if (index[b] + 1 == n[b] || index[c] + 1 == n[c]) continue;
      const WalkablePoint* const first = &grid.points[p];
      if (is_planar_quad(first[0], first[step[b]], first[step[b] + step[c]], first[step[c]]))
        continue;
      const auto at = static_cast<std::uint32_t>(index[axis]);
      range.add(axis, at == 0 ? 0 : at - 1, std::min(at + 1, n[axis] - 1));
      for (const std::size_t a : {b, c}) {
        const auto cell = static_cast<std::uint32_t>(index[a]);
        range.add(a, cell, cell + 1);
      }
    }
  };
  const IndexRange all = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, grid.points.size()), IndexRange{},
      [&](const auto& points, IndexRange range) {
        for (std::size_t p = points.begin(); p != points.end(); ++p) add_faces(p, range);
        return range;
      },
      std::plus<IndexRange>());
  CellBox box;
  if (all.high[0] == 0) return box;
  for (std::size_t a = 0; a < 3; ++a) {
    box.first[a] = all.low[a];
    box.size[a] = all.high[a] - all.low[a];
  }
  return box;
}

}  // namespace

std::size_t WalkableGrid::bytes() const {
  return points.size() * sizeof(WalkablePoint) + cell_values.size() * sizeof(float) +
         hidden.size() / 8 + boundary.size() * sizeof(BoundaryFace);
}

std::uint32_t WalkableGrid::neighbor(std::uint32_t cell, std::uint32_t face) const {
  const auto index = cell_index(cell);
  const std::size_t axis = face / 2;
  std::uint32_t step = 1;
  for (std::size_t a = 0; a < axis; ++a) step *= dimensions[a] - 1;
  std::uint32_t other;
  if (face % 2 == 0) {
    if (index[axis] == 0) return kNone;
    other = cell - step;
  } else {
    if (index[axis] + 2 == dimensions[axis]) return kNone;
    other = cell + step;
  }
  return !hidden.empty() && hidden[other] ? kNone : other;
}

WalkableGrid make_walkable_grid(const Mesh& mesh, const ScalarField& scalar, const Bounds& bounds) {
  WalkableGrid grid;
  grid.frame = LocalFrame::of(bounds);
  for (std::size_t a = 0; a < 3; ++a)
    grid.dimensions[a] = static_cast<std::uint32_t>(mesh.dimensions[a]);
  grid.left_handed = is_left_handed(mesh);
  const bool on_points = scalar.association == Association::point;
  grid.points.resize(mesh.point_count());
  mesh.points.visit([&](auto xyz) {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, grid.points.size()), [&](const auto& range) {
          for (std::size_t p = range.begin(); p != range.end(); ++p)
            grid.points[p] = grid.frame.local(
                static_cast<double>(xyz[3 * p]), static_cast<double>(xyz[3 * p + 1]),
                static_cast<double>(xyz[3 * p + 2]), on_points ? scalar.values[p] : 0.0f);
        });
  });
  if (!on_points) grid.cell_values = scalar.values;
  grid.twisted = box_of_twisted_faces(grid);

  Finding hidden{"hidden cells", 0, {}};
  const auto cells = static_cast<std::uint32_t>(grid.cell_count());
  if (!mesh.hidden_cells.empty()) {
    grid.hidden.resize(cells);
    for (std::uint32_t c = 0; c < cells; ++c) {
      grid.hidden[c] = mesh.hidden_cells.at<int>(c) != 0;
      if (grid.hidden[c]) add_example(hidden, c);
    }
    if (hidden.count > 0) grid.findings.push_back(std::move(hidden));
  }
  for (std::uint32_t c = 0; c < cells; ++c) {
    if (!grid.hidden.empty() && grid.hidden[c]) continue;
    for (std::uint32_t f = 0; f < 6; ++f)
      if (grid.neighbor(c, f) == kNone) grid.boundary.push_back({c, f});
  }
  return grid;
}

}  // namespace plume
