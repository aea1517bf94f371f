#include "plume/datasets/families.h"
#include "plume/datasets/grid.h"

namespace plume::datasets {
namespace {

/// Displacement of a face's corners along its normal, in edges. At the worst corner the Jacobian is
/// 1 - 12 twist^2 - 16 twist^3 of an untwisted cell's, here 0.52; it vanishes at 1/4.
constexpr double twist = 0.18;

}  // namespace

Mesh twisted(const GenerateOptions& options) {
  const int size = size_or(options, 56);
  require_int32_ids(std::pow(size + 1.0, 3), size);
  const Box box = Box::unit(size);

  std::vector<float> points;
  points.reserve(3 * box.point_count());
  std::array<int, 3> index{};
  for (index[2] = 0; index[2] <= size; ++index[2]) {
    for (index[1] = 0; index[1] <= size; ++index[1]) {
      for (index[0] = 0; index[0] <= size; ++index[0]) {
        for (std::size_t a = 0; a < 3; ++a) {
          double along = index[a];
          // Signs alternate over the two other axes, so that a face becomes a saddle. On the
          // boundary, points move within their plane only: it stays planar.
          if (index[a] > 0 && index[a] < size) {
            const bool odd = (index[(a + 1) % 3] + index[(a + 2) % 3]) % 2 != 0;
            along += odd ? -twist : twist;
          }
          points.push_back(static_cast<float>(along / size));
        }
      }
    }
  }

  Mesh mesh;
  mesh.points = Array::own(std::move(points));
  mesh.dimensions = {size + 1, size + 1, size + 1};
  add_box_fields(mesh);
  add_cell_radius(mesh);
  return mesh;
}

}  // namespace plume::datasets
