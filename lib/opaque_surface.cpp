#include "plume/lib/opaque_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plume/mesh/error.h"
#include "plume/mesh/explicit_cells.h"

namespace plume {
namespace {

template <class Vector>
bool all_finite(const Vector& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

std::optional<std::string> problem_of_color(const std::array<float, 3>& color) {
  if (all_finite(color) && std::all_of(color.begin(), color.end(), [](float c) { return c >= 0; }))
    return std::nullopt;
  return fmt::format("a colour of ({:g}, {:g}, {:g}): each channel must be finite and at least 0",
                     color[0], color[1], color[2]);
}

}  // namespace

std::optional<std::string> OpaqueSurface::problem() const {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!all_finite(points[i]))
      return fmt::format("point {} of the surface is ({:g}, {:g}, {:g}): it must be finite", i,
                         points[i][0], points[i][1], points[i][2]);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (const std::uint32_t point : triangles[i])
      if (point >= points.size())
        return fmt::format("triangle {} of the surface has point {}, but there are {} points", i,
                           point, points.size());
  for (const auto& [name, count] :
       {std::pair{"colours", point_colors.size()}, {"normals", point_normals.size()}})
    if (count != 0 && count != points.size())
      return fmt::format("the surface has {} {} for {} points: give one for each, or none", count,
                         name, points.size());
  if (auto problem = problem_of_color(color)) return problem;
  for (const auto& point_color : point_colors)
    if (auto problem = problem_of_color(point_color)) return problem;
  for (std::size_t i = 0; i < point_normals.size(); ++i)
    if (!all_finite(point_normals[i]))
      return fmt::format("normal {} of the surface is not finite", i);
  return std::nullopt;
}

void smooth_normals(OpaqueSurface& surface) {
  std::vector<std::array<double, 3>> sums(surface.points.size(), {0, 0, 0});
  for (const auto& [a, b, c] : surface.triangles) {
    std::array<double, 3> u, v;
    for (std::size_t i = 0; i < 3; ++i) {
      u[i] = surface.points[b][i] - surface.points[a][i];
      v[i] = surface.points[c][i] - surface.points[a][i];
    }
    const std::array<double, 3> across{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                       u[0] * v[1] - u[1] * v[0]};
    for (const std::uint32_t point : {a, b, c})
      for (std::size_t i = 0; i < 3; ++i) sums[point][i] += across[i];
  }
  surface.point_normals.resize(sums.size());
  for (std::size_t p = 0; p < sums.size(); ++p) {
    const double length = std::hypot(sums[p][0], sums[p][1], sums[p][2]);
    for (std::size_t i = 0; i < 3; ++i)
      surface.point_normals[p][i] = length > 0 ? static_cast<float>(sums[p][i] / length) : 0;
  }
}

OpaqueSurface side_of_grid(const Mesh& mesh, int side) {
  if (!mesh.is_grid())
    throw Error(
        "a side of the grid as a surface: the mesh is no single curvilinear or rectilinear grid");
  if (side < 0 || side > 5)
    throw Error(
        fmt::format("side {} of a grid: it must be 0 to 5, the first and last i, j and k", side));
  const std::array<std::size_t, 3> size{static_cast<std::size_t>(mesh.dimensions[0]),
                                        static_cast<std::size_t>(mesh.dimensions[1]),
                                        static_cast<std::size_t>(mesh.dimensions[2])};
  const std::array<std::size_t, 3> step{1, size[0], size[0] * size[1]};
  const auto axis = static_cast<std::size_t>(side / 2);
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const std::size_t first = side % 2 == 0 ? 0 : (size[axis] - 1) * step[axis];
  OpaqueSurface surface;
  for (std::size_t j = 0; j < size[v]; ++j)
    for (std::size_t i = 0; i < size[u]; ++i)
      surface.points.push_back(point_at(mesh, first + i * step[u] + j * step[v]));
  for (std::size_t j = 0; j + 1 < size[v]; ++j)
    for (std::size_t i = 0; i + 1 < size[u]; ++i) {
      const auto a = static_cast<std::uint32_t>(j * size[u] + i);
      const auto b = a + 1, d = a + static_cast<std::uint32_t>(size[u]), c = d + 1;
      surface.triangles.push_back({a, b, c});
      surface.triangles.push_back({a, c, d});
    }
  smooth_normals(surface);
  return surface;
}

}  // namespace plume
