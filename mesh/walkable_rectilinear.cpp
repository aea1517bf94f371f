#include "plume/mesh/walkable_rectilinear.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace plume {
namespace {

WalkableRectilinear::Axis axis_of(const Array& coordinates) {
  WalkableRectilinear::Axis axis;
  coordinates.visit([&](auto values) {
    for (const auto value : values) axis.coordinates.push_back(static_cast<double>(value));
  });
  // A width below 1e-308 has no finite reciprocal.
  for (std::size_t i = 1; i < axis.coordinates.size(); ++i)
    axis.per_width.push_back(std::min(1 / std::abs(axis.coordinates[i] - axis.coordinates[i - 1]),
                                      std::numeric_limits<double>::max()));
  return axis;
}

}  // namespace

std::size_t WalkableRectilinear::bytes() const {
  std::size_t bytes =
      (point_values.size() + cell_values.size()) * sizeof(float) + (hidden.size() + 7) / 8;
  for (const Axis& axis : axes)
    bytes += (axis.coordinates.size() + axis.per_width.size()) * sizeof(double);
  return bytes;
}

std::uint32_t WalkableRectilinear::neighbor(std::uint32_t cell, std::uint32_t face) const {
  const std::size_t axis = face / 2;
  std::uint32_t step = 1;
  for (std::size_t a = 0; a < axis; ++a) step *= points(a) - 1;
  const std::uint32_t cells = points(axis) - 1, index = cell / step % cells;
  const bool up = face % 2 == 1;
  if (up ? index + 1 == cells : index == 0) return kNone;
  const std::uint32_t other = up ? cell + step : cell - step;
  return is_hidden(other) ? kNone : other;
}

std::size_t WalkableRectilinear::boundary_face_count() const {
  if (hidden.empty()) {
    std::size_t faces = 0;
    for (std::size_t a = 0; a < 3; ++a) faces += 2 * (cell_count() / (points(a) - 1));
    return faces;
  }
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, cell_count(), 4096), std::size_t{0},
      [&](const auto& range, std::size_t sum) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          const auto cell = static_cast<std::uint32_t>(i);
          if (is_hidden(cell)) continue;
          for (std::uint32_t face = 0; face < 6; ++face)
            sum += neighbor(cell, face) == kNone ? 1 : 0;
        }
        return sum;
      },
      std::plus<std::size_t>());
}

WalkableRectilinear make_walkable_rectilinear(const Mesh& mesh, ScalarField scalar) {
  WalkableRectilinear grid;
  for (std::size_t a = 0; a < 3; ++a) grid.axes[a] = axis_of(mesh.axes[a]);
  (scalar.association == Association::point ? grid.point_values : grid.cell_values) =
      std::move(scalar.values);
  if (mesh.hidden_cells.empty()) return grid;
  Finding hidden{"hidden cells", 0, {}};
  grid.hidden.resize(grid.cell_count());
  mesh.hidden_cells.visit([&](auto values) {
    for (std::size_t cell = 0; cell < values.size(); ++cell) {
      grid.hidden[cell] = values[cell] != 0;
      if (grid.hidden[cell]) add_example(hidden, cell);
    }
  });
  if (hidden.count == 0)
    grid.hidden = {};
  else
    grid.findings.push_back(std::move(hidden));
  return grid;
}

}  // namespace plume
