#include "plume/mesh/rectilinear_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "plume/mesh/error.h"
#include "plume/mesh/face_matching.h"

namespace plume {
namespace {

constexpr char kAxes[] = "xyz";

// Requires two coordinates.
void check_axis(const Array& axis, char name) {
  axis.visit([name](auto values) {
    auto at = [&](std::size_t i) { return static_cast<double>(values[i]); };
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!std::isfinite(at(i)))
        throw Error(
            fmt::format("the {} coordinate {} is {}: coordinates must be finite; repair the axis",
                        name, i, at(i)));
    const bool ascending = at(values.size() - 1) > at(0);
    for (std::size_t i = 1; i < values.size(); ++i)
      if (!(ascending ? at(i) > at(i - 1) : at(i) < at(i - 1)))
        throw Error(
            fmt::format("the {} coordinate {} is {} after {}, but from {} to {} they must strictly "
                        "{}; sort them and the values with them, or give the grid's points (.vts)",
                        name, i, at(i), at(i - 1), at(0), at(values.size() - 1),
                        ascending ? "ascend" : "descend"));
  });
}

template <class T>
Array points_of(const Mesh& grid) {
  std::array<std::vector<T>, 3> axes;
  for (std::size_t a = 0; a < 3; ++a)
    grid.axes[a].visit([&](auto values) {
      for (const auto value : values) axes[a].push_back(static_cast<T>(value));
    });
  std::vector<T> points;
  points.reserve(3 * grid.point_count());
  for (const T z : axes[2])
    for (const T y : axes[1])
      for (const T x : axes[0]) points.insert(points.end(), {x, y, z});
  return Array::own(std::move(points));
}

}  // namespace

Bounds check_axes(const Mesh& mesh) {
  const auto& n = mesh.dimensions;
  if (!mesh.points.empty())
    throw Error(fmt::format(
        "a grid with coordinates along its axes and {} values of points; leave out one of the two",
        mesh.points.size()));
  for (std::size_t a = 0; a < 3; ++a)
    if (n[a] < 0 || static_cast<std::size_t>(n[a]) != mesh.axes[a].size())
      throw Error(fmt::format("a grid of {} x {} x {} points has {} coordinates along {}", n[0],
                              n[1], n[2], mesh.axes[a].size(), kAxes[a]));
  if (n[0] < 2 || n[1] < 2 || n[2] < 2)
    throw Error(fmt::format("a grid of {} x {} x {} points has no volume cells", n[0], n[1], n[2]));
  if (static_cast<double>(n[0]) * static_cast<double>(n[1]) * static_cast<double>(n[2]) >= kNone)
    throw Error(fmt::format("a grid of {} x {} x {} points has more than Plume can number", n[0],
                            n[1], n[2]));
  if (!mesh.hidden_cells.empty() && mesh.hidden_cells.size() != mesh.cell_count())
    throw Error(fmt::format("hidden_cells has {} values for {} cells", mesh.hidden_cells.size(),
                            mesh.cell_count()));
  Bounds bounds;
  for (std::size_t a = 0; a < 3; ++a) {
    check_axis(mesh.axes[a], kAxes[a]);
    const double first = mesh.axes[a].at<double>(0);
    const double last = mesh.axes[a].at<double>(mesh.axes[a].size() - 1);
    bounds.low[a] = std::min(first, last);
    bounds.high[a] = std::max(first, last);
  }
  return bounds;
}

std::optional<std::size_t> uneven_place(const Array& axis) {
  const std::size_t last = axis.size() - 1;
  const double low = axis.at<double>(0), high = axis.at<double>(last);
  const double unit = axis.type() == Array::Type::float32 ? std::numeric_limits<float>::epsilon()
                                                          : std::numeric_limits<double>::epsilon();
  const double tolerance = 4 * unit * std::max(std::abs(low), std::abs(high));
  const double spacing = (high - low) / static_cast<double>(last);
  for (std::size_t i = 0; i <= last; ++i)
    if (std::abs(axis.at<double>(i) - (low + static_cast<double>(i) * spacing)) > tolerance)
      return i;
  return std::nullopt;
}

Mesh with_points(const Mesh& rectilinear) {
  Mesh mesh = rectilinear;
  const bool single = std::all_of(mesh.axes.begin(), mesh.axes.end(), [](const Array& axis) {
    return axis.type() == Array::Type::float32;
  });
  mesh.points = single ? points_of<float>(rectilinear) : points_of<double>(rectilinear);
  mesh.axes = {};
  return mesh;
}

}  // namespace plume
