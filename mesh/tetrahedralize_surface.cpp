// What a closed surface encloses.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "plume/mesh/closed_surface.h"
#include "plume/mesh/distinct_points.h"
#include "plume/mesh/error.h"
#include "plume/mesh/tetrahedralization_engines.h"
#include "plume/mesh/tetrahedralize.h"
#include "plume/mesh/tetrahedron_quality.h"

namespace plume {
namespace {

void check_settings(const SurfaceMeshing& meshing) {
  const auto outside = [](double value, double low, double high) {
    return !(value >= low && value <= high);  // also where it is not a number
  };
  if (meshing.radius_edge_ratio != 0 && outside(meshing.radius_edge_ratio, 1, 1000))
    throw Error(fmt::format("the radius-edge ratio {} is not from 1 to 1000, nor 0 for no bound",
                            meshing.radius_edge_ratio));
  if (outside(meshing.dihedral_angle, 0, 40))
    throw Error(
        fmt::format("the dihedral angle {} is not from 0 to 40 degrees", meshing.dihedral_angle));
  if (meshing.dihedral_angle > 0 && meshing.radius_edge_ratio == 0)
    throw Error("a dihedral angle is asked for and no radius-edge ratio; give both");
  if (!(meshing.volume >= 0) || !std::isfinite(meshing.volume))
    throw Error(fmt::format("the largest volume {} is no positive number, nor 0 for no bound",
                            meshing.volume));
  if (meshing.added_points < 1)
    throw Error(fmt::format("{} points cannot be added; at least 1", meshing.added_points));
}

// The surface between distinct points, without triangles of which corners coincide.
struct Cleaned {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> numbers;  // in the surface given
};

Cleaned clean(const TriangleSurface& surface, const DistinctPoints& points,
              std::vector<Finding>& findings) {
  Cleaned cleaned;
  Finding collapsed{"triangles with equal corners: left out", 0, {}};
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    auto corners = surface.triangles[t];
    for (std::uint32_t& corner : corners) {
      if (corner >= surface.vertices.point_count())
        throw Error(fmt::format("triangle {} has point {}, but the surface has points 0 to {}", t,
                                corner, surface.vertices.point_count() - 1));
      if (!points.place.empty()) corner = points.place[corner];
    }
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
      add_example(collapsed, t);
      continue;
    }
    cleaned.triangles.push_back(corners);
    cleaned.numbers.push_back(static_cast<std::uint32_t>(t));
  }
  if (collapsed.count > 0) findings.push_back(std::move(collapsed));
  return cleaned;
}

// The tetrahedra that are enclosed and their points, renumbered in their order.
Mesh keep_enclosed(const TetgenMesh& filled) {
  const auto ints = [](const Array& array) {
    return std::span<const std::int32_t>(static_cast<const std::int32_t*>(array.data()),
                                         array.size());
  };
  const auto corners = ints(filled.tetrahedra);
  const std::vector<bool> kept = enclosed(corners, ints(filled.neighbors), ints(filled.facets));
  std::vector<std::int32_t> number(filled.points.size() / 3, -1), connectivity;
  for (std::size_t t = 0; t < kept.size(); ++t)
    if (kept[t])
      for (std::size_t c = 0; c < 4; ++c) number[static_cast<std::size_t>(corners[4 * t + c])] = 0;
  std::vector<double> points;
  std::int32_t next = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = next++;
    for (std::size_t a = 0; a < 3; ++a) points.push_back(filled.points.at<double>(3 * i + a));
  }
  for (std::size_t t = 0; t < kept.size(); ++t)
    if (kept[t])
      for (std::size_t c = 0; c < 4; ++c)
        connectivity.push_back(number[static_cast<std::size_t>(corners[4 * t + c])]);
  Mesh mesh;
  mesh.points = Array::own(std::move(points));
  mesh.cells.types =
      Array::own(std::vector<std::uint8_t>{static_cast<std::uint8_t>(CellType::tetrahedron)});
  mesh.cells.connectivity = Array::own(std::move(connectivity));
  return mesh;
}

// TetGen's last optimization may leave a few tetrahedra beyond the bounds.
void check_bounds(const Mesh& mesh, const SurfaceMeshing& meshing, std::vector<Finding>& findings) {
  constexpr double kRounding = 1 + 1e-9;
  double worst_ratio = 0, worst_angle = 180, worst_volume = 0;
  Finding ratio, angle, volume;
  for (std::size_t t = 0; t < mesh.cell_count(); ++t) {
    std::array<std::array<double, 3>, 4> points;
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t a = 0; a < 3; ++a)
        points[c][a] =
            mesh.points.at<double>(3 * mesh.cells.connectivity.at<std::size_t>(4 * t + c) + a);
    const TetrahedronQuality quality = quality_of(points);
    worst_ratio = std::max(worst_ratio, quality.radius_edge_ratio);
    worst_angle = std::min(worst_angle, quality.dihedral_angle);
    worst_volume = std::max(worst_volume, quality.volume);
    if (meshing.radius_edge_ratio > 0 &&
        quality.radius_edge_ratio > meshing.radius_edge_ratio * kRounding)
      add_example(ratio, t);
    if (quality.dihedral_angle * kRounding < meshing.dihedral_angle) add_example(angle, t);
    if (meshing.volume > 0 && quality.volume > meshing.volume * kRounding) add_example(volume, t);
  }
  ratio.what = fmt::format("of {} tetrahedra have a radius-edge ratio above {} (at most {:.3g})",
                           mesh.cell_count(), meshing.radius_edge_ratio, worst_ratio);
  angle.what = fmt::format("of {} tetrahedra have a dihedral angle below {} (at least {:.3g})",
                           mesh.cell_count(), meshing.dihedral_angle, worst_angle);
  volume.what = fmt::format("of {} tetrahedra have a volume above {} (at most {:.3g})",
                            mesh.cell_count(), meshing.volume, worst_volume);
  for (Finding* finding : {&ratio, &angle, &volume})
    if (finding->count > 0) findings.push_back(std::move(*finding));
}

}  // namespace

Tetrahedralization tetrahedralize(const TriangleSurface& surface, const SurfaceMeshing& meshing) {
  check_settings(meshing);
  Tetrahedralization result;
  result.engine = "TetGen";
  const DistinctPoints points = distinct_points(surface.vertices, result.findings);
  const Cleaned cleaned = clean(surface, points, result.findings);
  if (cleaned.triangles.empty()) throw Error("the surface has no triangles");
  check_closed(points.coordinates, cleaned.triangles, cleaned.numbers);
  const TetgenMesh filled =
      tetgen_fill(points.coordinates, cleaned.triangles, cleaned.numbers, meshing);
  result.mesh = keep_enclosed(filled);
  check_bounds(result.mesh, meshing, result.findings);
  const std::size_t added = filled.points.size() / 3 - points.count();
  if (added >= static_cast<std::size_t>(meshing.added_points))
    result.findings.push_back(
        {"points added, the most that were allowed: refinement is not finished", added, {}});
  if (!surface.vertices.fields.empty())
    result.findings.push_back({"fields of the surface left out: points inside have no values",
                               surface.vertices.fields.size(),
                               {}});
  return result;
}

}  // namespace plume
