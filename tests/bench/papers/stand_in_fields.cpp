#include "plume/tests/bench/papers/stand_in_fields.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "plume/datasets/generate.h"

namespace plume::bench {
namespace {

using Point = std::array<double, 3>;

double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// From 1 well inside of a surface to 0 well outside.
double inside(double signed_distance, double width) {
  return 1 / (1 + std::exp(signed_distance / width));
}

// Signed distance to an ellipsoid, nearly.
double ellipsoid(const Point& p, const Point& center, const Point& radii) {
  const double q = std::hypot((p[0] - center[0]) / radii[0], (p[1] - center[1]) / radii[1],
                              (p[2] - center[2]) / radii[2]);
  return (q - 1) * std::min({radii[0], radii[1], radii[2]});
}

struct Capsule {
  Point from, to;
  double radius;

  double signed_distance(const Point& p) const {
    double along = 0, length2 = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      along += (p[a] - from[a]) * (to[a] - from[a]);
      length2 += (to[a] - from[a]) * (to[a] - from[a]);
    }
    const double u = std::clamp(along / length2, 0.0, 1.0);
    Point nearest;
    for (std::size_t a = 0; a < 3; ++a) nearest[a] = from[a] + u * (to[a] - from[a]);
    return distance(p, nearest) - radius;
  }
};

double nearest_of(const std::vector<Capsule>& capsules, const Point& p) {
  double least = 10;
  for (const Capsule& capsule : capsules) least = std::min(least, capsule.signed_distance(p));
  return least;
}

double waves(const Point& p, double per_edge) {
  const double k = 2 * std::numbers::pi * per_edge;
  return std::sin(k * p[0] + 2 * std::sin(k * p[1])) * std::sin(k * p[1] + 2 * std::sin(k * p[2])) *
         std::sin(k * p[2] + 2 * std::sin(k * p[0]));
}

// All even permutations of (0, 1, 3g), (1, 2 + g, 2g) and (g, 2, 2g + 1) with all signs, g the
// golden ratio.
std::vector<Point> truncated_icosahedron(double radius) {
  constexpr double g = std::numbers::phi;
  std::vector<Point> made;
  for (const Point& seed : {Point{0, 1, 3 * g}, {1, 2 + g, 2 * g}, {g, 2, 2 * g + 1}})
    for (std::size_t turn = 0; turn < 3; ++turn)
      for (int signs = 0; signs < 8; ++signs) {
        if (seed[0] == 0 && (signs & 1)) continue;
        Point p;
        for (std::size_t a = 0; a < 3; ++a)
          p[(a + turn) % 3] = (signs >> a & 1 ? -1 : 1) * seed[a] * radius / std::hypot(1, 3 * g);
        made.push_back({p[0] + 0.5, p[1] + 0.5, p[2] + 0.5});
      }
  return made;
}

template <class F>
Array values_at(std::size_t count, const F& f) {
  std::vector<float> values(count);
  tbb::parallel_for(std::size_t{0}, count,
                    [&](std::size_t i) { values[i] = static_cast<float>(f(i)); });
  return Array::own(std::move(values));
}

}  // namespace

double orbital_field(const Point& p) {
  const double x = p[0] - 0.5, y = p[1] - 0.5, z = p[2] - 0.5;
  const double r = 36 * std::hypot(x, y, z);  // in Bohr radii; the cube is 36 wide
  const double shape = 36 * 36 * (3 * z * z - (x * x + y * y + z * z));
  const double wave = shape * std::exp(-r / 3);
  return std::min(1.0, wave * wave / 24.3);
}

double bucky_ball_field(const Point& p) {
  static const std::vector<Point> atoms = truncated_icosahedron(0.38);
  double sum = 0;
  for (const Point& atom : atoms) {
    const double d = distance(p, atom) / 0.05;
    sum += std::exp(-d * d);
  }
  return std::min(1.0, 0.6 * sum);
}

double neghip_field(const Point& p) {
  struct Charge {
    Point at;
    double size;
  };
  static const std::vector<Charge> charges = [] {
    std::mt19937_64 random(1);
    auto unit = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    std::vector<Charge> made;
    for (int i = 0; i < 24; ++i)
      made.push_back(
          {{0.1 + 0.8 * unit(), 0.1 + 0.8 * unit(), 0.1 + 0.8 * unit()}, i % 2 == 0 ? 1.0 : -1.0});
    return made;
  }();
  double sum = 0;
  for (const Charge& charge : charges) {
    const double d = distance(p, charge.at);
    sum += charge.size * std::exp(-6 * d) / (d + 0.06);
  }
  return std::clamp(0.5 + 0.04 * sum, 0.0, 1.0);
}

double fuel_field(const Point& p) {
  const double along = p[2], width = 0.05 + 0.16 * along;
  const double bend = 0.03 * std::sin(11 * along);
  const double off = std::hypot(p[0] - 0.5 - bend, p[1] - 0.5 + bend) / width;
  const double ripple = 1 + 0.35 * along * waves(p, 2.5);
  return std::clamp(std::exp(-off * off * ripple) * (1 - 0.6 * along) * inside(along - 0.85, 0.04),
                    0.0, 1.0);
}

double aneurism_field(const Point& p) {
  static const std::vector<Capsule> vessels = [] {
    std::mt19937_64 random(2);
    auto unit = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    std::vector<Capsule> made;
    Point at{0.5, 0.5, 0.02};
    for (int i = 0; i < 16; ++i) {
      const Point next{0.1 + 0.8 * unit(), 0.1 + 0.8 * unit(), 0.1 + 0.8 * unit()};
      made.push_back({at, next, 0.008 + 0.014 * unit()});
      if (i % 3 != 2) at = next;
    }
    return made;
  }();
  return std::max(inside(nearest_of(vessels, p), 0.006),
                  inside(distance(p, {0.62, 0.45, 0.5}) - 0.07, 0.006));
}

double engine_field(const Point& p) {
  double box = -1;
  const Point half{0.42, 0.3, 0.2};
  for (std::size_t a = 0; a < 3; ++a)
    box = std::max(box, std::abs(p[a] - (a == 2 ? 0.23 : 0.5)) - half[a]);
  double bores = 1;
  for (const double x : {0.25, 0.5, 0.75})
    bores = std::min(bores, std::hypot(p[0] - x, p[1] - 0.5) - 0.09);
  const double metal = inside(std::max(box, -bores), 0.006);
  const double pistons = inside(std::max(bores + 0.015, std::abs(p[2] - 0.2) - 0.04), 0.006);
  return std::max(0.5 * metal, pistons);
}

double bonsai_field(const Point& p) {
  static const Capsule trunk{{0.5, 0.5, 0.2}, {0.56, 0.48, 0.6}, 0.035};
  const double pot =
      std::max(std::hypot(p[0] - 0.5, p[1] - 0.5) - 0.28, std::abs(p[2] - 0.12) - 0.06);
  const double crown = ellipsoid(p, {0.54, 0.5, 0.72}, {0.34, 0.34, 0.2}) + 0.07 * waves(p, 6);
  return std::max({0.8 * inside(trunk.signed_distance(p), 0.006), inside(pot, 0.006),
                   0.35 * inside(crown, 0.01)});
}

double head_field(const Point& p) {
  const Point center{0.5, 0.5, 0.45}, radii{0.36, 0.44, 0.42};
  const double d = ellipsoid(p, center, radii) + 0.01 * waves(p, 2);
  const double skin = 0.3 * inside(d, 0.006);
  const double skull = inside(std::abs(d + 0.055) - 0.018, 0.006);
  const double brain = (0.45 + 0.1 * waves(p, 7)) * inside(d + 0.1, 0.008);
  return std::max({skin, skull, brain});
}

double foot_field(const Point& p) {
  static const std::vector<Capsule> bones = [] {
    std::vector<Capsule> made{{{0.5, 0.2, 0.3}, {0.5, 0.2, 0.95}, 0.05},
                              {{0.5, 0.12, 0.2}, {0.5, 0.4, 0.3}, 0.06}};
    for (int toe = 0; toe < 5; ++toe) {
      const double x = 0.3 + 0.1 * toe;
      made.push_back({{0.42 + 0.04 * toe, 0.45, 0.28}, {x, 0.7, 0.18}, 0.022});
      made.push_back({{x, 0.73, 0.18}, {x, 0.88 - 0.02 * toe, 0.12}, 0.018});
    }
    return made;
  }();
  const double leg = Capsule{{0.5, 0.2, 0.3}, {0.5, 0.2, 0.95}, 0.13}.signed_distance(p);
  const double sole = ellipsoid(p, {0.5, 0.5, 0.2}, {0.3, 0.46, 0.15});
  return std::max(0.3 * inside(std::min(leg, sole), 0.006),
                  0.9 * inside(nearest_of(bones, p), 0.005));
}

Mesh stand_in_grid(StandInField field, const std::array<int, 3>& points) {
  const double edge = 1.0 / (std::max({points[0], points[1], points[2]}) - 1);
  Mesh mesh;
  for (std::size_t a = 0; a < 3; ++a) {
    mesh.dimensions[a] = points[a];
    std::vector<double> along;
    for (int i = 0; i < points[a]; ++i) along.push_back(i * edge);
    mesh.axes[a] = Array::own(std::move(along));
  }
  const auto nx = static_cast<std::size_t>(points[0]), ny = static_cast<std::size_t>(points[1]);
  mesh.fields.push_back(
      {"density", Association::point, 1, values_at(mesh.point_count(), [&](std::size_t i) {
         return field({static_cast<double>(i % nx) * edge, static_cast<double>(i / nx % ny) * edge,
                       static_cast<double>(i / nx / ny) * edge});
       })});
  mesh.active_field = "density";
  return mesh;
}

Mesh stand_in_tetrahedra(StandInField field, int size) {
  Mesh mesh = generate("box-tetrahedra", {size, 0.2, 1});
  mesh.fields = {
      {"density", Association::point, 1, values_at(mesh.point_count(), [&](std::size_t i) {
         return field({mesh.points.at<double>(3 * i), mesh.points.at<double>(3 * i + 1),
                       mesh.points.at<double>(3 * i + 2)});
       })}};
  mesh.active_field = "density";
  return mesh;
}

}  // namespace plume::bench
