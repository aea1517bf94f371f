#include <algorithm>

#include "plume/datasets/families.h"
#include "plume/datasets/grid.h"

namespace plume::datasets {
namespace {

/// A honeycomb in the unit square, laid out as a wall of bricks: `size` rows; a brick of row r
/// spans two half-bricks, and odd rows are shifted by one. A brick has six corners, two of them
/// where bricks of the next row meet, which are moved up or down to make it a hexagon.
class Honeycomb {
 public:
  explicit Honeycomb(int size) : size_(size), ids_(columns() * rows(), -1) {
    for (int row = 0; row <= size; ++row) {
      for (int column = 0; column <= 2 * size; ++column) {
        if (!is_corner(column, row)) continue;
        ids_[slot(column, row)] = static_cast<std::int32_t>(points_.size());
        const double shift = 1.0 / 6 * (wall_above(column, row) - wall_below(column, row));
        points_.push_back({column / (2.0 * size), (row + shift) / size});
      }
    }
    for (int row = 0; row < size; ++row) {
      int left = 0;
      for (int right = 1; right <= 2 * size; ++right) {
        if (!is_wall(right, row)) continue;
        add_polygon(left, right, row);
        left = right;
      }
    }
  }

  const std::vector<std::array<double, 2>>& points() const { return points_; }
  /// Each cell's points, counterclockwise.
  const std::vector<std::vector<std::int32_t>>& polygons() const { return polygons_; }

 private:
  std::size_t columns() const { return 2 * static_cast<std::size_t>(size_) + 1; }
  std::size_t rows() const { return static_cast<std::size_t>(size_) + 1; }
  std::size_t slot(int column, int row) const {
    return static_cast<std::size_t>(row) * columns() + static_cast<std::size_t>(column);
  }
  /// Does an upright wall of this row stand at this column?
  bool is_wall(int column, int row) const {
    return column == 0 || column == 2 * size_ || (column - row) % 2 == 0;
  }
  int wall_above(int column, int row) const {
    return row < size_ && row > 0 && is_wall(column, row);
  }
  int wall_below(int column, int row) const {
    return row < size_ && row > 0 && is_wall(column, row - 1);
  }
  bool is_corner(int column, int row) const {
    if (row == 0) return is_wall(column, 0);
    if (row == size_) return is_wall(column, size_ - 1);
    return true;
  }
  void add_polygon(int left, int right, int row) {
    std::vector<std::int32_t> polygon;
    for (int column = left; column <= right; ++column) {
      if (const auto id = ids_[slot(column, row)]; id >= 0) polygon.push_back(id);
    }
    for (int column = right; column >= left; --column) {
      if (const auto id = ids_[slot(column, row + 1)]; id >= 0) polygon.push_back(id);
    }
    polygons_.push_back(std::move(polygon));
  }

  int size_;
  std::vector<std::int32_t> ids_;
  std::vector<std::array<double, 2>> points_;
  std::vector<std::vector<std::int32_t>> polygons_;
};

std::vector<double> prism_points(const Honeycomb& honeycomb, int size,
                                 const GenerateOptions& options) {
  std::vector<double> points;
  std::uint64_t item = 0;
  for (int layer = 0; layer <= size; ++layer) {
    for (const auto& corner : honeycomb.points()) {
      Point p{corner[0], corner[1], static_cast<double>(layer) / size};
      const bool inside = std::all_of(p.begin(), p.end(), [](double x) { return x > 0 && x < 1; });
      if (inside && options.jitter > 0) {
        for (std::size_t a = 0; a < 3; ++a) {
          const double offset = random_offset(options.seed, item, static_cast<int>(a));
          p[a] = std::clamp(p[a] + options.jitter * offset / (2 * size), 0.0, 1.0);
        }
      }
      points.insert(points.end(), p.begin(), p.end());
      ++item;
    }
  }
  return points;
}

}  // namespace

Mesh box_polyhedra(const GenerateOptions& options) {
  const int size = size_or(options, 12);
  require_int32_ids((2.0 * size + 1) * std::pow(size + 1.0, 2), size);
  const Honeycomb honeycomb(size);
  const auto per_layer = static_cast<std::int64_t>(honeycomb.points().size());

  std::vector<std::int64_t> offsets{0}, connectivity, locations, faces;
  for (int layer = 0; layer < size; ++layer) {
    const std::int64_t below = layer * per_layer;
    const std::int64_t above = below + per_layer;
    for (const auto& polygon : honeycomb.polygons()) {
      for (auto id : polygon) connectivity.push_back(below + id);
      for (auto id : polygon) connectivity.push_back(above + id);
      offsets.push_back(static_cast<std::int64_t>(connectivity.size()));

      locations.push_back(static_cast<std::int64_t>(faces.size()));
      const auto corners = static_cast<std::int64_t>(polygon.size());
      faces.push_back(corners + 2);
      faces.push_back(corners);
      for (auto id = polygon.rbegin(); id != polygon.rend(); ++id) faces.push_back(below + *id);
      faces.push_back(corners);
      for (auto id : polygon) faces.push_back(above + id);
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto a = polygon[i];
        const auto b = polygon[(i + 1) % polygon.size()];
        faces.insert(faces.end(), {4, below + a, below + b, above + b, above + a});
      }
    }
  }

  Mesh mesh;
  mesh.points = Array::own(prism_points(honeycomb, size, options));
  mesh.cells.types =
      Array::own(std::vector<std::uint8_t>{static_cast<std::uint8_t>(CellType::polyhedron)});
  mesh.cells.offsets = Array::own(std::move(offsets));
  mesh.cells.connectivity = Array::own(std::move(connectivity));
  mesh.cells.polyhedron_locations = Array::own(std::move(locations));
  mesh.cells.polyhedron_faces = Array::own(std::move(faces));
  add_box_fields(mesh);
  return mesh;
}

}  // namespace plume::datasets
