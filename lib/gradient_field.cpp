#include "plume/lib/gradient_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "plume/mesh/cell_shape.h"
#include "plume/traverse/inner_scalar.h"
#include "plume/traverse/isoparametric.h"

namespace plume {
namespace {

using Vector = GradientField::Vector;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

bool is_finite(const Vector& v) { return std::isfinite(v[0] + v[1] + v[2]); }

Vector local_place(const LocalFrame& frame, const Vector& world) {
  Vector local;
  for (std::size_t a = 0; a < 3; ++a) local[a] = (world[a] - frame.center[a]) * frame.scale;
  return local;
}

std::vector<std::uint32_t> points_of(const WalkableCells& walkable, std::uint32_t cell) {
  std::vector<std::uint32_t> ids;
  for (const std::uint32_t face : walkable.faces_of(cell)) {
    const auto loop = walkable.loop(face);
    ids.insert(ids.end(), loop.begin(), loop.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

// Puts values of the user's points in the order of the walkable ones.
template <class Walkable>
std::vector<float> reordered(const Walkable& walkable, const std::vector<float>& of_points) {
  assert(3 * walkable.point_numbers.size() == of_points.size());
  std::vector<float> values(3 * walkable.points.size());
  for (std::size_t user = 0; user < walkable.point_numbers.size(); ++user) {
    const std::uint32_t number = walkable.point_numbers[user];
    if (number != kNone) std::copy_n(&of_points[3 * user], 3, &values[3 * std::size_t{number}]);
  }
  return values;
}

// Weights of the eight corners a + 2b + 4c of a cell.
std::array<double, 8> trilinear_weights(const Vector& parameters) {
  std::array<double, 8> weights;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    weights[corner] = 1;
    for (std::size_t a = 0; a < 3; ++a)
      weights[corner] *= (corner >> a & 1) != 0 ? parameters[a] : 1 - parameters[a];
  }
  return weights;
}

}  // namespace

GradientField::GradientField(const WalkableTets& walkable, std::vector<float> of_points)
    : values_(reordered(walkable, of_points)) {}

GradientField::GradientField(const WalkableCells& walkable, std::vector<float> of_points)
    : values_(reordered(walkable, of_points)) {}

GradientField::GradientField(const WalkableGrid&, std::vector<float> of_points)
    : values_(std::move(of_points)) {}

GradientField::GradientField(const WalkableRectilinear&, std::vector<float> of_points)
    : values_(std::move(of_points)) {}

void GradientField::put(const WalkableTets& walkable, std::vector<float> of_points) {
  values_ = reordered(walkable, of_points);
}

void GradientField::put(const WalkableCells& walkable, std::vector<float> of_points) {
  values_ = reordered(walkable, of_points);
}

void GradientField::put(const WalkableGrid&, std::vector<float> of_points) {
  values_ = std::move(of_points);
}

void GradientField::put(const WalkableRectilinear&, std::vector<float> of_points) {
  values_ = std::move(of_points);
}

std::size_t GradientField::bytes() const { return values_.size() * sizeof(float); }

Vector GradientField::weighted(std::span<const std::uint32_t> points,
                               std::span<const double> weights) const {
  Vector sum{0, 0, 0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector gradient = value(points[i]);
    for (std::size_t a = 0; a < 3; ++a) sum[a] += weights[i] * gradient[a];
  }
  return sum;
}

template <class Walkable>
Vector GradientField::by_distance(const Walkable& walkable, std::span<const std::uint32_t> points,
                                  const Vector& local) const {
  Vector sum{0, 0, 0};
  double total = 0;
  for (const std::uint32_t point : points) {
    const Vector gradient = value(point);
    if (!is_finite(gradient)) continue;
    double squared = 1e-30;
    for (std::size_t a = 0; a < 3; ++a)
      squared += std::pow(walkable.points[point].position[a] - local[a], 2);
    for (std::size_t a = 0; a < 3; ++a) sum[a] += gradient[a] / squared;
    total += 1 / squared;
  }
  for (double& x : sum) x /= total;  // 0 / 0 where no point has a gradient
  return sum;
}

template <class Walkable>
Vector GradientField::in_tetrahedron(const Walkable& walkable,
                                     std::span<const std::uint32_t> points,
                                     const Vector& local) const {
  std::array<PointValue, 4> p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = point_value(walkable.points[points[i]]);
  const InverseJacobian inverse({p[1] - p[0], p[2] - p[0], p[3] - p[0]});
  if (inverse.is_regular()) {
    const auto [u, v, w] = inverse.step(p[0], local);
    const Vector result = weighted(points, std::array{1 - u - v - w, u, v, w});
    if (is_finite(result)) return result;
  }
  return by_distance(walkable, points, local);
}

Vector GradientField::at(const WalkableTets& walkable, std::uint32_t cell,
                         const Vector& place) const {
  const auto points = walkable.points_of(cell);
  const Vector local = local_place(walkable.frame, place);
  return in_tetrahedron(walkable, points, local);
}

Vector GradientField::at(const WalkableGrid& walkable, std::uint32_t cell,
                         const Vector& place) const {
  const std::uint32_t ni = walkable.dimensions[0], nij = ni * walkable.dimensions[1];
  const std::uint32_t first = walkable.first_point(cell);
  std::array<std::uint32_t, 8> points;
  std::array<WalkablePoint, 8> corners;
  for (std::uint32_t c = 0; c < 8; ++c) {
    points[c] = first + (c & 1) + (c >> 1 & 1) * ni + (c >> 2) * nij;
    corners[c] = walkable.points[points[c]];
  }
  const Vector local = local_place(walkable.frame, place);
  const MultilinearMap map = MultilinearMap::hexahedron(corners);
  if (const auto parameters = invert(map, local, map.center())) {
    const Vector result = weighted(points, trilinear_weights(*parameters));
    if (is_finite(result)) return result;
  }
  return by_distance(walkable, points, local);
}

Vector GradientField::at(const WalkableRectilinear& walkable, std::uint32_t cell,
                         const Vector& place) const {
  const std::uint32_t ci = walkable.points(0) - 1, cj = walkable.points(1) - 1;
  const std::array<std::uint32_t, 3> index{cell % ci, cell / ci % cj, cell / ci / cj};
  Vector parameters;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto& axis = walkable.axes[a];
    const double along = (place[a] - axis.coordinates[index[a]]) * axis.per_width[index[a]];
    parameters[a] = std::clamp(axis.ascending() ? along : -along, 0.0, 1.0);
  }
  std::array<std::uint32_t, 8> points;
  for (std::uint32_t c = 0; c < 8; ++c)
    points[c] =
        index[0] + (c & 1) +
        walkable.points(0) * (index[1] + (c >> 1 & 1) + walkable.points(1) * (index[2] + (c >> 2)));
  const std::array<double, 8> weights = trilinear_weights(parameters);
  Vector sum{0, 0, 0};
  double total = 0;
  for (std::size_t c = 0; c < 8; ++c) {
    const Vector gradient = value(points[c]);
    if (!is_finite(gradient)) continue;
    for (std::size_t a = 0; a < 3; ++a) sum[a] += weights[c] * gradient[a];
    total += weights[c];
  }
  for (double& x : sum) x /= total;  // 0 / 0 where no corner has a gradient
  return sum;
}

// The cell alone, as a mesh of its own whose scalar is one component of the gradient: what
// interpolates scalars in cells of any kind then interpolates gradients.
Vector GradientField::at(const WalkableCells& walkable, std::uint32_t cell,
                         const Vector& place) const {
  const std::vector<std::uint32_t> points = plume::points_of(walkable, cell);
  const Vector local = local_place(walkable.frame, place);
  if (shape_of(walkable, cell).type == CellType::tetrahedron)
    return in_tetrahedron(walkable, points, local);
  WalkableCells alone;
  alone.frame = walkable.frame;
  for (const std::uint32_t id : points) alone.points.push_back(walkable.points[id]);
  alone.face_begin = {0};
  alone.cell_begin = {0};
  for (const std::uint32_t face : walkable.faces_of(cell)) {
    for (const std::uint32_t id : walkable.loop(face))
      alone.face_points.push_back(static_cast<std::uint32_t>(
          std::lower_bound(points.begin(), points.end(), id) - points.begin()));
    alone.face_begin.push_back(static_cast<std::uint32_t>(alone.face_points.size()));
    const bool owned = walkable.face_sides[face].owner == cell;
    alone.face_sides.push_back({owned ? 0u : 1u, owned ? 1u : 0u});
    alone.cell_faces.push_back(static_cast<std::uint32_t>(alone.cell_faces.size()));
  }
  alone.cell_begin.push_back(static_cast<std::uint32_t>(alone.cell_faces.size()));
  Vector result;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t i = 0; i < points.size(); ++i)
      alone.points[i].scalar = static_cast<float>(value(points[i])[a]);
    float component = kNaN;
    if (!scalars_inside(alone, 0, std::span(&local, 1), &component) || !std::isfinite(component))
      return by_distance(walkable, points, local);
    result[a] = component;
  }
  return result;
}

}  // namespace plume
