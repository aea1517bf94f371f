#include "plume/mesh/cell_to_point.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/point_cells.h"

namespace plume {
namespace {

using Place = std::array<double, 3>;

std::vector<Place> centers_of_cells(const Mesh& mesh, const CellReader& cells) {
  std::vector<Place> centers(cells.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size()), [&](const auto& range) {
    std::vector<std::uint32_t> ids;
    for (std::size_t cell = range.begin(); cell != range.end(); ++cell) {
      cells.points(cell, ids);
      Place sum{0, 0, 0};
      for (const std::uint32_t id : ids) {
        const Place p = point_at(mesh, id);
        for (std::size_t a = 0; a < 3; ++a) sum[a] += p[a];
      }
      for (std::size_t a = 0; a < 3; ++a)
        centers[cell][a] = sum[a] / static_cast<double>(ids.size());
    }
  });
  return centers;
}

}  // namespace

ScalarField average_to_points(const Mesh& mesh, const ScalarField& scalar) {
  assert(scalar.association == Association::cell);
  const CellReader cells(mesh);
  const std::vector<Place> centers = centers_of_cells(mesh, cells);
  const PointCells point_cells(mesh);
  ScalarField result;
  result.name = scalar.name;
  result.association = Association::point;
  result.values.resize(mesh.point_count());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, result.values.size()), [&](const auto& range) {
        std::vector<std::uint32_t> around;
        for (std::size_t p = range.begin(); p != range.end(); ++p) {
          point_cells.around(p, around);
          const Place here = point_at(mesh, p);
          // From the first value, so that equal values leave nothing to round.
          double weights = 0, sum = 0, first = 0;
          std::size_t at_the_point = 0;
          for (const std::uint32_t cell : around) {
            const double value = scalar.values[cell];
            if (std::isnan(value)) continue;
            const double distance = std::hypot(
                centers[cell][0] - here[0], centers[cell][1] - here[1], centers[cell][2] - here[2]);
            if (distance == 0 && at_the_point++ == 0) weights = 0;
            if (distance > 0 && at_the_point > 0) continue;
            const double weight = distance > 0 ? 1 / distance : 1;
            if (weights == 0) {
              first = value;
              sum = 0;
            }
            weights += weight;
            sum += weight * (value - first);
          }
          result.values[p] = weights > 0 ? static_cast<float>(first + sum / weights)
                                         : std::numeric_limits<float>::quiet_NaN();
        }
      });
  float low = std::numeric_limits<float>::infinity(), high = -low;
  std::vector<std::uint32_t> around;
  for (std::size_t p = 0; p < result.values.size(); ++p) {
    const float value = result.values[p];
    if (std::isnan(value)) {
      point_cells.around(p, around);
      result.not_finite += around.empty() ? 0 : 1;
    } else {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (low <= high) {
    result.low = low;
    result.high = high;
  }
  return result;
}

}  // namespace plume
