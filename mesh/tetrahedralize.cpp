#include "plume/mesh/tetrahedralize.h"

#include <fmt/format.h>

#include <utility>

#include "plume/mesh/distinct_points.h"
#include "plume/mesh/error.h"
#include "plume/mesh/tetrahedralization_engines.h"

namespace plume {
namespace {

using Engine = TetrahedralizationEngine;

Engine choose(Engine engine) {
  if (engine != Engine::automatic) return engine;
  if (has_tetgen()) return Engine::tetgen;
  if (has_cgal()) return Engine::cgal;
  throw Error(
      "points become tetrahedra by TetGen or CGAL, and this build has neither: configure with "
      "-DPLUME_WITH_TETGEN=ON (Debian: libtet1.5-dev; its licence is the AGPL) or "
      "-DPLUME_WITH_CGAL=ON (Debian: libcgal-dev; GPL)");
}

void check_enough(const PointSet& set, const DistinctPoints& points) {
  if (points.count() >= 4) return;
  std::string text = fmt::format("{} points", set.point_count());
  if (points.count() < set.point_count())
    text += fmt::format(", of which {} differ", points.count());
  for (std::size_t i = 0; i < points.count(); ++i)
    text += (i == 0 ? ": " : ", ") + describe_point(points, i);
  throw Error(text + "; a tetrahedron needs four that are not in one plane");
}

Array by_tetgen(const DistinctPoints& points) {
  try {
    return tetgen_delaunay(points.coordinates);
  } catch (const Error& error) {
    if (!has_tetgen()) throw;
    throw Error(fmt::format("{}; {}; tetrahedra need a volume{}", error.what(),
                            describe_spread(points),
                            has_cgal() ? ", and CGAL takes points that are nearly flat" : ""));
  }
}

// CGAL uses every point; TetGen has a tolerance.
void check_all_used(const DistinctPoints& points, const Array& corners) {
  std::vector<bool> used(points.count(), false);
  corners.visit([&](auto ids) {
    for (const auto id : ids) used[static_cast<std::size_t>(id)] = true;
  });
  std::string examples;
  std::size_t unused = 0;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i] && ++unused <= 5) examples += ' ' + describe_point(points, i);
  if (unused > 0)
    throw Error(
        fmt::format("TetGen leaves out {} points, too close to others{}{}; merge them, or use CGAL",
                    unused, unused > 5 ? ", among them" : ":", examples));
}

}  // namespace

bool has_engine(Engine engine) {
  switch (engine) {
    case Engine::tetgen:
      return has_tetgen();
    case Engine::cgal:
      return has_cgal();
    case Engine::automatic:
      break;
  }
  return has_tetgen() || has_cgal();
}

Tetrahedralization tetrahedralize(const PointSet& set, Engine engine) {
  const Engine chosen = choose(engine);
  Tetrahedralization result;
  const DistinctPoints points = distinct_points(set, result.findings);
  check_enough(set, points);
  result.engine = chosen == Engine::tetgen ? "TetGen" : "CGAL";
  const Array corners =
      chosen == Engine::tetgen ? by_tetgen(points) : cgal_delaunay(points.coordinates);
  if (corners.empty())
    throw Error(fmt::format("{}; tetrahedra need a volume", describe_spread(points)));
  check_all_used(points, corners);
  take_points(set, points, result.mesh);
  result.mesh.cells.types =
      Array::own(std::vector<std::uint8_t>{static_cast<std::uint8_t>(CellType::tetrahedron)});
  result.mesh.cells.connectivity = corners;
  return result;
}

}  // namespace plume
