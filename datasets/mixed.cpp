#include <algorithm>

#include "plume/datasets/families.h"
#include "plume/datasets/grid.h"

namespace plume::datasets {
namespace {

/// How a cuboid of the grid is cut. Wedges cut its faces of constant z, tetrahedra all its faces.
enum class Cut { hexahedron, wedges, tetrahedra, pyramids };

Cut cut_of(int size, int i, int k) {
  const int half = (size + 1) / 2;
  if (i < half) {
    // Next to tetrahedra, whose side towards us is cut into triangles: a hexahedron cannot match.
    const bool meets_tetrahedra = i == half - 1 && half < size && k >= half;
    return meets_tetrahedra ? Cut::pyramids : Cut::hexahedron;
  }
  return k < half ? Cut::wedges : Cut::tetrahedra;
}

/// Explicit cells of several types, as they are appended.
struct CellList {
  std::vector<std::uint8_t> types;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> connectivity;

  /// Ends the cells whose points have been appended since the last call.
  void end_cells(CellType type) {
    const std::int64_t points = points_per_cell(type);
    while (offsets.back() < static_cast<std::int64_t>(connectivity.size())) {
      types.push_back(static_cast<std::uint8_t>(type));
      offsets.push_back(offsets.back() + points);
    }
  }
};

/// Five pyramids and, where the cuboid's face of largest i is cut along its diagonal, two
/// tetrahedra.
void append_pyramids(const std::array<std::int32_t, 8>& c, std::int32_t middle, CellList& cells) {
  // Each base is listed so that its normal points to the middle.
  auto& ids = cells.connectivity;
  ids.insert(ids.end(), {c[0], c[3], c[7], c[4], middle});
  ids.insert(ids.end(), {c[0], c[4], c[5], c[1], middle});
  ids.insert(ids.end(), {c[3], c[2], c[6], c[7], middle});
  ids.insert(ids.end(), {c[0], c[1], c[2], c[3], middle});
  ids.insert(ids.end(), {c[4], c[7], c[6], c[5], middle});
  cells.end_cells(CellType::pyramid);
  ids.insert(ids.end(), {c[1], c[6], c[2], middle, c[1], c[5], c[6], middle});
  cells.end_cells(CellType::tetrahedron);
}

void append_mean(const std::array<std::int32_t, 8>& corners, std::vector<float>& points) {
  for (std::size_t a = 0; a < 3; ++a) {
    double sum = 0;
    for (std::int32_t c : corners) {
      sum += static_cast<double>(points[3 * static_cast<std::size_t>(c) + a]);
    }
    points.push_back(static_cast<float>(sum / 8));
  }
}

}  // namespace

Mesh box_mixed(const GenerateOptions& options) {
  const int size = size_or(options, 16);
  // The points in the middle of cuboids come on top.
  require_int32_ids(std::pow(size + 1.0, 3) + std::pow(size, 2.0), size);
  std::vector<float> points = unit_box_points(size, options);
  const Box box = Box::unit(size);

  CellList cells;
  for_each_cuboid(box, [&](int i, int j, int k) {
    const auto corners = box.corners(i, j, k);
    switch (cut_of(size, i, k)) {
      case Cut::hexahedron:
        cells.connectivity.insert(cells.connectivity.end(), corners.begin(), corners.end());
        cells.end_cells(CellType::hexahedron);
        break;
      case Cut::wedges:
        append_wedges(corners, cells.connectivity);
        cells.end_cells(CellType::wedge);
        break;
      case Cut::tetrahedra:
        append_kuhn_tetrahedra(corners, cells.connectivity);
        cells.end_cells(CellType::tetrahedron);
        break;
      case Cut::pyramids: {
        const auto middle = static_cast<std::int32_t>(points.size() / 3);
        append_mean(corners, points);
        append_pyramids(corners, middle, cells);
        break;
      }
    }
  });

  Mesh mesh;
  mesh.points = Array::own(std::move(points));
  mesh.cells.types = Array::own(std::move(cells.types));
  mesh.cells.offsets = Array::own(std::move(cells.offsets));
  mesh.cells.connectivity = Array::own(std::move(cells.connectivity));
  add_box_fields(mesh);
  return mesh;
}

}  // namespace plume::datasets
