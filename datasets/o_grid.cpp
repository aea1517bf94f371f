#include <numbers>

#include "plume/datasets/families.h"
#include "plume/datasets/grid.h"

namespace plume::datasets {
namespace {

struct Direction {
  double cosine, sine;
};

/// Direction number `index` of `count` around the circle; the last is the first, bit for bit, and
/// quarter turns are exact.
Direction around(int index, int count) {
  const int i = index % count;
  if (4 * i % count == 0) {
    constexpr std::array<Direction, 4> quarters{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    return quarters[static_cast<std::size_t>(4 * i / count)];
  }
  const double angle = 2 * std::numbers::pi * i / count;
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

Mesh o_grid(const GenerateOptions& options) {
  const int size = size_or(options, 24);
  require_int32_ids((size + 1.0) * (4.0 * size + 1) * (size + 1.0), size);

  std::vector<double> points;
  for (int k = 0; k <= size; ++k) {
    for (int j = 0; j <= 4 * size; ++j) {
      const Direction direction = around(j, 4 * size);
      for (int i = 0; i <= size; ++i) {
        const double radius = 0.5 * i / size;
        points.insert(points.end(), {0.5 + radius * direction.cosine, 0.5 + radius * direction.sine,
                                     static_cast<double>(k) / size});
      }
    }
  }

  Mesh mesh;
  mesh.points = Array::own(std::move(points));
  mesh.dimensions = {size + 1, 4 * size + 1, size + 1};
  add_box_fields(mesh);
  return mesh;
}

Mesh sphere(const GenerateOptions& options) {
  const int size = size_or(options, 24);
  require_int32_ids((size + 1.0) * (2.0 * size + 1) * (4.0 * size + 1), size);

  std::vector<double> points;
  for (int k = 0; k <= 4 * size; ++k) {
    const Direction azimuth = around(k, 4 * size);
    for (int j = 0; j <= 2 * size; ++j) {
      // Half of the circle, from +z; exact at the poles and the equator.
      const Direction polar = around(j, 4 * size);
      for (int i = 0; i <= size; ++i) {
        const double radius = static_cast<double>(i) / size;
        // Adding 0 turns a -0 into a 0, so that points that coincide do so bit for bit.
        points.insert(points.end(),
                      {radius * polar.sine * azimuth.cosine + 0.0,
                       radius * polar.sine * azimuth.sine + 0.0, radius * polar.cosine + 0.0});
      }
    }
  }

  Mesh mesh;
  mesh.points = Array::own(std::move(points));
  mesh.dimensions = {size + 1, 2 * size + 1, 4 * size + 1};
  add_box_fields(mesh, {0, 0, 0});
  return mesh;
}

}  // namespace plume::datasets
