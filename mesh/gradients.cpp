#include "plume/mesh/gradients.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "plume/mesh/error.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/point_cells.h"

namespace plume {
namespace {

using Vector = std::array<double, 3>;

Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Three directions and by how much the scalar changes along each: equations for a gradient.
struct Differences {
  std::array<Vector, 3> direction;
  Vector scalar;

  double determinant() const { return dot(direction[0], cross(direction[1], direction[2])); }
  /// The gradient times the determinant.
  Vector scaled_gradient() const {
    Vector sum{0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector normal = cross(direction[(i + 1) % 3], direction[(i + 2) % 3]);
      for (std::size_t a = 0; a < 3; ++a) sum[a] += scalar[i] * normal[a];
    }
    return sum;
  }
  bool lie_in_a_plane() const {
    constexpr double kFlat = 1e-8;
    double lengths = 1;
    for (const Vector& d : direction) lengths *= std::sqrt(dot(d, d));
    return !(std::abs(determinant()) > kFlat * lengths);
  }
};

/// Gradients weighted by the volumes that their directions span. Never divides by one of them.
class VolumeMean {
 public:
  void add(const Differences& d) {
    if (!std::isfinite(d.scalar[0] + d.scalar[1] + d.scalar[2]) || d.lie_in_a_plane()) return;
    const double determinant = d.determinant();
    const Vector scaled = d.scaled_gradient();
    for (std::size_t a = 0; a < 3; ++a) sum_[a] += determinant > 0 ? scaled[a] : -scaled[a];
    volume_ += std::abs(determinant);
  }
  std::optional<Vector> gradient() const {
    if (!(volume_ > 0)) return std::nullopt;
    return Vector{sum_[0] / volume_, sum_[1] / volume_, sum_[2] / volume_};
  }

 private:
  Vector sum_{0, 0, 0};
  double volume_ = 0;
};

/// The gradient that fits differences to many neighbours best.
class LeastSquares {
 public:
  void add(const Vector& way, double difference) {
    const double length2 = dot(way, way);
    if (!(length2 > 0) || !std::isfinite(difference)) return;
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column)
        normal_.direction[row][column] += way[row] * way[column] / length2;
      normal_.scalar[row] += way[row] * difference / length2;
    }
  }
  std::optional<Vector> gradient() const {
    constexpr double kFlat = 1e-12;
    const double determinant = normal_.determinant();
    const double trace =
        normal_.direction[0][0] + normal_.direction[1][1] + normal_.direction[2][2];
    if (!(determinant > kFlat * trace * trace * trace)) return std::nullopt;
    Vector g = normal_.scaled_gradient();
    for (double& x : g) x /= determinant;
    return g;
  }

 private:
  Differences normal_{};
};

/// The corners at the other ends of a corner's three edges.
constexpr std::uint8_t kHexahedronEdges[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                                 {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
constexpr std::uint8_t kVoxelEdges[8][3] = {{1, 2, 4}, {0, 3, 5}, {3, 0, 6}, {2, 1, 7},
                                            {5, 6, 0}, {4, 7, 1}, {7, 4, 2}, {6, 5, 3}};
constexpr std::uint8_t kTetrahedronEdges[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};

class Gradients {
 public:
  Gradients(const Mesh& mesh, const std::vector<float>& scalar)
      : mesh_(mesh), scalar_(scalar), cells_(mesh), around_(mesh) {}

  Vector operator()(std::size_t point) const {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    std::vector<std::uint32_t> cells;
    around_.around(point, cells);
    if (!std::isnan(scalar_[point]) && !cells.empty()) {
      if (const auto g = mesh_.is_grid() ? along_the_grid(point) : of_the_cells(point, cells))
        return *g;
      if (const auto g = least_squares(point, cells)) return *g;
    }
    return {kNaN, kNaN, kNaN};
  }

 private:
  Vector place(std::size_t point) const { return point_at(mesh_, point); }
  double change(std::size_t from, std::size_t to) const {
    return static_cast<double>(scalar_[to]) - scalar_[from];
  }

  std::optional<Vector> along_the_grid(std::size_t point) const {
    std::array<std::size_t, 3> n, index;
    for (std::size_t a = 0; a < 3; ++a) n[a] = static_cast<std::size_t>(mesh_.dimensions[a]);
    index = {point % n[0], point / n[0] % n[1], point / n[0] / n[1]};
    Differences d;
    std::size_t step = 1;
    for (std::size_t a = 0; a < 3; step *= n[a++]) {
      // How far one may go either way, up to two steps.
      auto reach = [&](bool forward) {
        std::size_t steps = 0, from = point, at = index[a];
        for (; steps < 2 && (forward ? at + 1 < n[a] : at > 0); ++steps) {
          const std::size_t to = forward ? from + step : from - step;
          if (std::isnan(scalar_[to]) || !share_a_cell(from, to)) break;
          from = to;
          forward ? ++at : --at;
        }
        return steps;
      };
      const std::size_t ahead = reach(true), behind = reach(false);
      if (ahead == 0 && behind == 0) return std::nullopt;
      if (ahead > 0 && behind > 0) {
        take(d, a, {point - step, point + step}, {-0.5, 0.5});
      } else {
        auto at = [&](std::size_t k) { return ahead > 0 ? point + k * step : point - k * step; };
        const double side = ahead > 0 ? 1 : -1;
        if (ahead + behind == 2)
          take(d, a, {point, at(1), at(2)}, {-1.5 * side, 2 * side, -0.5 * side});
        else
          take(d, a, {point, at(1)}, {-side, side});
      }
    }
    if (d.lie_in_a_plane()) return std::nullopt;
    Vector g = d.scaled_gradient();
    for (double& x : g) x /= d.determinant();
    return g;
  }

  // Weighted differences of positions and scalars, from the first of the points: no digits lost
  // far from the origin. The weights sum to zero.
  void take(Differences& d, std::size_t a, std::initializer_list<std::size_t> points,
            std::initializer_list<double> weights) const {
    const std::size_t first = *points.begin();
    const Vector origin = place(first);
    d.direction[a] = {0, 0, 0};
    d.scalar[a] = 0;
    const double* weight = weights.begin();
    for (const std::size_t p : points) {
      const Vector way = place(p) - origin;
      for (std::size_t axis = 0; axis < 3; ++axis) d.direction[a][axis] += *weight * way[axis];
      d.scalar[a] += *weight * change(first, p);
      ++weight;
    }
  }

  // Whether a visible cell has both points.
  bool share_a_cell(std::size_t a, std::size_t b) const {
    if (mesh_.hidden_cells.empty()) return true;
    std::vector<std::uint32_t> of_a, of_b;
    around_.around(a, of_a);
    around_.around(b, of_b);
    for (std::size_t i = 0, j = 0; i < of_a.size() && j < of_b.size();) {
      if (of_a[i] == of_b[j]) return true;
      of_a[i] < of_b[j] ? ++i : ++j;
    }
    return false;
  }

  // Tetrahedra alone, or hexahedra and voxels alone.
  std::optional<Vector> of_the_cells(std::size_t point,
                                     const std::vector<std::uint32_t>& around) const {
    VolumeMean mean;
    std::vector<std::uint32_t> ids;
    const bool tetrahedra = cells_.type(around[0]) == CellType::tetrahedron;
    for (const std::uint32_t cell : around) {
      const CellType type = cells_.type(cell);
      const bool is_box = type == CellType::hexahedron || type == CellType::voxel;
      if (tetrahedra ? type != CellType::tetrahedron : !is_box) return std::nullopt;
      cells_.points(cell, ids);
      for (std::size_t corner = 0; corner < ids.size(); ++corner) {
        if (ids[corner] != point) continue;
        const auto& edges = tetrahedra                ? kTetrahedronEdges[corner]
                            : type == CellType::voxel ? kVoxelEdges[corner]
                                                      : kHexahedronEdges[corner];
        Differences d;
        for (std::size_t e = 0; e < 3; ++e) {
          d.direction[e] = place(ids[edges[e]]) - place(point);
          d.scalar[e] = change(point, ids[edges[e]]);
        }
        mean.add(d);
      }
    }
    return mean.gradient();
  }

  std::optional<Vector> least_squares(std::size_t point,
                                      const std::vector<std::uint32_t>& around) const {
    LeastSquares fit;
    const Vector here = place(point);
    std::vector<std::uint32_t> ids;
    for (const std::uint32_t cell : around) {
      cells_.points(cell, ids);
      for (const std::uint32_t id : ids) fit.add(place(id) - here, change(point, id));
    }
    return fit.gradient();
  }

  const Mesh& mesh_;
  const std::vector<float>& scalar_;
  CellReader cells_;
  PointCells around_;
};

}  // namespace

std::vector<float> point_gradients(const Mesh& mesh, const ScalarField& scalar) {
  if (scalar.association == Association::cell)
    throw Error(
        fmt::format("'{}' is cell data, which has no gradient at points: average it to the "
                    "points first (average_to_points)",
                    scalar.name));
  const Gradients gradients(mesh, scalar.values);
  std::vector<float> result(3 * mesh.point_count());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.point_count()), [&](const auto& range) {
    for (std::size_t p = range.begin(); p != range.end(); ++p) {
      const Vector g = gradients(p);
      for (std::size_t a = 0; a < 3; ++a) result[3 * p + a] = static_cast<float>(g[a]);
    }
  });
  return result;
}

}  // namespace plume
