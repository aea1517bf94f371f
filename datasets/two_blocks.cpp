#include <algorithm>

#include "plume/datasets/families.h"
#include "plume/datasets/grid.h"

namespace plume::datasets {

Mesh two_blocks(const GenerateOptions& options) {
  const int size = size_or(options, 16);
  const int across = std::max(1, size / 2);
  require_int32_ids(2 * (across + 1.0) * (size + 1.0) * (size + 1.0), size);

  std::vector<float> points;
  std::vector<std::int32_t> connectivity;
  for (const double low : {0.0, 0.5}) {
    const Box box{{across, size, size}, {low, 0, 0}, {low + 0.5, 1, 1}};
    const auto first = static_cast<std::int32_t>(points.size() / 3);
    append_box_points(box, options.jitter, options.seed, points);
    for_each_cuboid(box, [&](int i, int j, int k) {
      for (auto corner : box.corners(i, j, k)) connectivity.push_back(first + corner);
    });
  }

  Mesh mesh;
  mesh.points = Array::own(std::move(points));
  mesh.cells = cells_of(CellType::hexahedron, std::move(connectivity));
  add_box_fields(mesh);
  return mesh;
}

}  // namespace plume::datasets
