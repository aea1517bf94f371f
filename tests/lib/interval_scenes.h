/// Fields, classifications and pictures for the tests of intervals and isosurfaces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "plume/lib/plume.h"
#include "plume/mesh/explicit_cells.h"

namespace plume::test {

using Point = std::array<double, 3>;
using Function = std::function<double(const Point&)>;

inline constexpr double kBound = 1e-5;  // linear RGBA

inline const char* const kForms[] = {"box-tetrahedra", "box-hexahedra",   "box-mixed", "box-wedges",
                                     "box-polyhedra",  "box-rectilinear", "two-blocks"};

inline double linear(const Point& p) { return p[0] + 2 * p[1] + 3 * p[2]; }

inline Mesh with(Mesh mesh, const Function& of, double scale = 1) {
  std::vector<double> values, points;
  for (std::size_t p = 0; p < mesh.point_count(); ++p) {
    const Point at = point_at(mesh, p);
    values.push_back(of(at));
    for (const double x : at) points.push_back(x * scale);
  }
  mesh.fields = {{"value", Association::point, 1, Array::own(std::move(values))}};
  mesh.active_field = "value";
  if (scale != 1) mesh.points = Array::own(std::move(points));
  return mesh;
}

// A volume, two intervals that touch, one apart, and three isosurfaces, for a field from 0 to 6.
inline Classification everything(float scalar_scale = 1, float space_scale = 1) {
  Classification all;
  all.volume =
      TransferFunction{{{0, {0.2f, {0, 0, 1}}}, {3, {2, {0, 1, 0}}}, {6, {0.5f, {1, 0, 0}}}}};
  for (auto& knot : all.volume->knots) {
    knot.scalar *= scalar_scale;
    knot.optics.extinction /= space_scale;
  }
  const TransferFunction profile{
      {{0, {0.1f, {1, 1, 0}}}, {0.5f, {1, {0, 1, 1}}}, {1, {0, {1, 0, 1}}}}};
  all.intervals = {{1 * scalar_scale, 1.5f * scalar_scale, profile},
                   {1.5f * scalar_scale, 2 * scalar_scale, even_profile(0.3f, {1, 1, 1})},
                   {4 * scalar_scale, 4.5f * scalar_scale, even_profile(0.4f, {0.5f, 0, 0})}};
  all.isosurfaces = {{1.75f * scalar_scale, 0.2f, {1, 0, 0}},
                     {3 * scalar_scale, 0.5f, {0, 1, 0}},
                     {5.25f * scalar_scale, 0.3f, {0, 0, 1}}};
  return all;
}

inline RenderSettings exact(int size) {
  RenderSettings settings;
  settings.width = settings.height = size;
  settings.early_termination = 0;
  return settings;
}

inline Camera askew(const Bounds& bounds) { return fitted_camera(bounds, {-0.7, 0.4, -0.59}); }

// Infinite where something is not a number.
inline double worst_difference(const Image& a, const Image& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    const double off = std::abs(static_cast<double>(a.rgba[i]) - b.rgba[i]);
    if (!(off <= worst)) worst = std::isnan(off) ? std::numeric_limits<double>::infinity() : off;
  }
  return worst;
}

inline bool has(const std::vector<std::string>& plan, const std::string& words) {
  for (const std::string& line : plan)
    if (line.find(words) != std::string::npos) return true;
  return false;
}

}  // namespace plume::test
