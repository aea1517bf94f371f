#include "plume/mesh/put_scalars.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cassert>
#include <utility>

namespace plume {
namespace {

template <class Body>
void for_each(std::size_t count, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
  });
}

// Forms that have points and cells in an order of their own.
template <class Walkable>
void put_in_order(Walkable& mesh, const ScalarField& scalar) {
  if (scalar.association == Association::point) {
    assert(mesh.point_numbers.size() == scalar.values.size() && mesh.cell_values.empty());
    for_each(scalar.values.size(), [&](std::size_t point) {
      const std::uint32_t number = mesh.point_numbers[point];
      if (number != kNone) mesh.points[number].scalar = scalar.values[point];
    });
    return;
  }
  assert(mesh.original_cells.size() == mesh.cell_values.size());
  for_each(mesh.cell_values.size(), [&](std::size_t cell) {
    mesh.cell_values[cell] = scalar.values[mesh.original_cells[cell]];
  });
}

}  // namespace

void put_scalars(WalkableTets& mesh, ScalarField scalar) { put_in_order(mesh, scalar); }

void put_scalars(WalkableCells& mesh, ScalarField scalar) { put_in_order(mesh, scalar); }

void put_scalars(WalkableGrid& mesh, ScalarField scalar) {
  if (scalar.association == Association::cell) {
    assert(mesh.cell_values.size() == scalar.values.size());
    mesh.cell_values = std::move(scalar.values);
    return;
  }
  assert(mesh.points.size() == scalar.values.size() && mesh.cell_values.empty());
  for_each(mesh.points.size(),
           [&](std::size_t point) { mesh.points[point].scalar = scalar.values[point]; });
}

void put_scalars(WalkableRectilinear& mesh, ScalarField scalar) {
  auto& values = scalar.association == Association::point ? mesh.point_values : mesh.cell_values;
  assert(values.size() == scalar.values.size());
  values = std::move(scalar.values);
}

}  // namespace plume
