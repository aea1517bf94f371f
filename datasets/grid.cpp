#include "plume/datasets/grid.h"

#include <algorithm>
#include <limits>
#include <span>
#include <string>

#include "plume/mesh/error.h"

namespace plume::datasets {

double random_offset(std::uint64_t seed, std::uint64_t item, int axis) {
  std::uint64_t z = seed * 0xd1342543de82ef95u +
                    (3 * item + static_cast<std::uint64_t>(axis) + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  // 53 bits fill a double's mantissa; the standard's distributions differ between libraries.
  return static_cast<double>(z >> 11) * 0x1p-52 - 1.0;
}

void require_int32_ids(double point_count, int size) {
  if (point_count > std::numeric_limits<std::int32_t>::max()) {
    throw Error("generate: size " + std::to_string(size) + " makes " +
                std::to_string(static_cast<std::uint64_t>(point_count)) +
                " points, more than 32-bit ids can number; choose a smaller size");
  }
}

void append_box_points(const Box& box, double jitter, std::uint64_t seed,
                       std::vector<float>& points) {
  points.reserve(points.size() + 3 * box.point_count());
  std::uint64_t item = points.size() / 3;
  std::array<int, 3> index{};
  for (index[2] = 0; index[2] <= box.cells[2]; ++index[2]) {
    for (index[1] = 0; index[1] <= box.cells[1]; ++index[1]) {
      for (index[0] = 0; index[0] <= box.cells[0]; ++index[0], ++item) {
        bool inside = true;
        for (std::size_t a = 0; a < 3; ++a) {
          inside = inside && index[a] > 0 && index[a] < box.cells[a];
        }
        for (std::size_t a = 0; a < 3; ++a) {
          const double extent = box.high[a] - box.low[a];
          double along = index[a];
          if (inside && jitter > 0)
            along += jitter * random_offset(seed, item, static_cast<int>(a));
          along = std::clamp(along / box.cells[a], 0.0, 1.0);
          points.push_back(static_cast<float>(box.low[a] + extent * along));
        }
      }
    }
  }
}

std::vector<float> unit_box_points(int size, const GenerateOptions& options) {
  require_int32_ids(std::pow(size + 1.0, 3), size);
  std::vector<float> points;
  append_box_points(Box::unit(size), options.jitter, options.seed, points);
  return points;
}

void append_kuhn_tetrahedra(const std::array<std::int32_t, 8>& c,
                            std::vector<std::int32_t>& connectivity) {
  // Paths from corner 0 to corner 6 along three edges; in an odd one the middle two are exchanged.
  connectivity.insert(connectivity.end(),
                      {c[0], c[1], c[2], c[6], c[0], c[2], c[3], c[6], c[0], c[3], c[7], c[6],
                       c[0], c[7], c[4], c[6], c[0], c[4], c[5], c[6], c[0], c[5], c[1], c[6]});
}

void append_wedges(const std::array<std::int32_t, 8>& c, std::vector<std::int32_t>& connectivity) {
  // VTK wants the first triangle's normal to point out of the wedge (vtkWedge.h).
  connectivity.insert(connectivity.end(),
                      {c[0], c[2], c[1], c[4], c[6], c[5], c[0], c[3], c[2], c[4], c[7], c[6]});
}

void add_box_fields(Mesh& mesh, const Point& center) {
  add_point_field(mesh, "linear", [](const Point& p) { return p[0] + 2 * p[1] + 3 * p[2]; });
  add_point_field(mesh, "radius", [&](const Point& p) { return distance(p, center); });
  add_point_field(mesh, "waves", [](const Point& p) {
    return 0.4 * std::sin(6 * p[0] + 1) * std::cos(5 * p[1]) +
           0.35 * std::sin(9 * p[1] + 4 * p[2]) + 0.25 * std::cos(17 * p[2] - 7 * p[0] + 3 * p[1]);
  });
  mesh.active_field = "radius";
}

namespace {

/// Distance to the unit cube's centre of the mean of some points.
float mean_radius(std::span<const float> points, std::span<const std::int32_t> ids) {
  Point mean{0, 0, 0};
  for (std::int32_t id : ids) {
    for (std::size_t a = 0; a < 3; ++a) {
      mean[a] += static_cast<double>(points[3 * static_cast<std::size_t>(id) + a]);
    }
  }
  for (double& m : mean) m /= static_cast<double>(ids.size());
  return static_cast<float>(distance(mean, {0.5, 0.5, 0.5}));
}

}  // namespace

void add_cell_radius(Mesh& mesh) {
  const std::span<const float> points(static_cast<const float*>(mesh.points.data()),
                                      mesh.points.size());
  std::vector<float> values;
  if (mesh.is_grid()) {
    const Box box{{static_cast<int>(mesh.dimensions[0]) - 1,
                   static_cast<int>(mesh.dimensions[1]) - 1,
                   static_cast<int>(mesh.dimensions[2]) - 1}};
    for_each_cuboid(box, [&](int i, int j, int k) {
      values.push_back(mean_radius(points, box.corners(i, j, k)));
    });
  } else {
    const auto per_cell = static_cast<std::size_t>(
        points_per_cell(static_cast<CellType>(mesh.cells.types.at<int>(0))));
    const std::span<const std::int32_t> ids(
        static_cast<const std::int32_t*>(mesh.cells.connectivity.data()),
        mesh.cells.connectivity.size());
    values.reserve(ids.size() / per_cell);
    for (std::size_t first = 0; first < ids.size(); first += per_cell) {
      values.push_back(mean_radius(points, ids.subspan(first, per_cell)));
    }
  }
  mesh.fields.push_back({"cell_radius", Association::cell, 1, Array::own(std::move(values))});
}

Cells cells_of(CellType type, std::vector<std::int32_t> connectivity) {
  Cells cells;
  cells.types = Array::own(std::vector<std::uint8_t>{static_cast<std::uint8_t>(type)});
  cells.connectivity = Array::own(std::move(connectivity));
  return cells;
}

}  // namespace plume::datasets
