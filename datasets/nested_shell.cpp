#include <algorithm>
#include <cmath>

#include "plume/datasets/families.h"
#include "plume/datasets/grid.h"

namespace plume::datasets {
namespace {

/// 0 below -width, 1 above width, smooth in between.
double step(double x, double width) {
  const double t = std::clamp(0.5 + 0.5 * x / width, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// 1 within a sphere, 0 outside.
double ball(const Point& p, const Point& center, double radius, double width) {
  return step(radius - distance(p, center), width);
}

double blend(double a, double b, double t) { return a + (b - a) * t; }

// `width`: half of that of a shell's edges, of the head's radius.
double attenuation(const Point& p, double width) {
  const double x = (p[0] - 0.5) / 0.34, y = (p[1] - 0.5) / 0.43, z = (p[2] - 0.5) / 0.45;
  // The jaw is narrower than the crown.
  const double narrow = 1 + 0.18 * step(-z, 0.8);
  double depth = 1 - std::sqrt(x * x * narrow * narrow + y * y * narrow + z * z);
  // A nose and a brow, between which the eyes lie.
  depth += 0.10 * ball(p, {0.5, 0.08, 0.46}, 0.05, 0.06);
  depth += 0.015 * std::cos(7 * x) * std::cos(9 * y + 1) * std::cos(8 * z);

  const double folds = 0.012 * std::sin(34 * p[0]) * std::sin(31 * p[1] + 1) * std::sin(37 * p[2]);
  double value = 0.35 * step(depth, width);
  value += 0.65 * step(depth - 0.09, width);
  value -= 0.75 * step(depth - 0.20, width);
  value += 0.25 * step(depth - 0.26 + folds * step(depth - 0.22, 0.05), width);

  for (const double side : {-1.0, 1.0}) {
    const Point socket{0.5 + side * 0.13, 0.115, 0.54};
    value = blend(value, std::min(value, 0.08), ball(p, socket, 0.075, 0.015));
    const Point eye{0.5 + side * 0.13, 0.135, 0.54};
    value = blend(value, 0.45, ball(p, eye, 0.045, 0.012));
  }
  return value;
}

}  // namespace

Mesh nested_shell(const GenerateOptions& options) {
  GenerateOptions box = options;
  box.size = size_or(options, 48);
  Mesh mesh = box_tetrahedra(box);
  mesh.fields.clear();
  // Edges as wide as two cells where that leaves the shells apart, so that the mesh can hold them.
  const double width = std::clamp(2.5 / box.size, 0.02, 0.04);
  add_point_field(mesh, "attenuation", [&](const Point& p) { return attenuation(p, width); });
  mesh.active_field = "attenuation";
  return mesh;
}

}  // namespace plume::datasets
