#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "plume/datasets/families.h"
#include "plume/datasets/grid.h"

// A picture of a flow, not a solution of it: the bow shock's shape, the jump across it, the
// pressure on the fin and the temperature in the boundary layers follow published correlations; the
// rest is interpolated between them.

namespace plume::datasets {
namespace {

constexpr double gamma = 1.4;
constexpr double mach = 2.95;
/// Freestream: density 1, speed of sound 1.
constexpr double free_pressure = 1 / gamma;
constexpr double total_sound2 = 1 + (gamma - 1) / 2 * mach * mach;

/// The fin: nose radius 1, straight sides of this length; the domain's height.
constexpr double side_length = 3;
constexpr double height = 5;

double square(double x) { return x * x; }
double blend(double a, double b, double t) { return a + (b - a) * t; }

/// The bow shock of a cylinder of radius 1: a hyperbola (F. S. Billig, "Shock-wave shapes around
/// spherical- and cylindrical-nosed bodies", J. Spacecraft and Rockets 4(6), 1967).
struct BowShock {
  double standoff = 0.386 * std::exp(4.67 / square(mach));
  double radius = 1.386 * std::exp(1.8 / std::pow(mach - 1, 0.75));
  double tangent2 = 1 / (square(mach) - 1);  ///< of the Mach angle, squared

  /// x of the shock at a distance y from the plane of symmetry.
  double x(double y) const {
    const double root = std::sqrt(1 + square(y) * tangent2 / square(radius));
    return -1 - standoff + radius / tangent2 * (root - 1);
  }
  /// Mach number normal to the shock.
  double normal_mach(double y) const {
    const double root = std::sqrt(1 + square(y) * tangent2 / square(radius));
    return mach / std::sqrt(1 + square(y / (radius * root)));
  }
};

double density_jump(double normal_mach) {
  const double m2 = square(normal_mach);
  return (gamma + 1) * m2 / ((gamma - 1) * m2 + 2);
}

double pressure_jump(double normal_mach) {
  return 1 + 2 * gamma / (gamma + 1) * (square(normal_mach) - 1);
}

/// Pressure at the stagnation point over that of the freestream (Rayleigh's pitot formula).
double pitot() {
  const double m2 = square(mach);
  return std::pow((gamma + 1) / 2 * m2, gamma / (gamma - 1)) *
         std::pow((gamma + 1) / (2 * gamma * m2 - gamma + 1), 1 / (gamma - 1));
}

/// A place on the fin's outline, and what stands off from it along its normal.
struct Station {
  double x = 0, y = 0;
  double normal_x = 0, normal_y = 0;
  double from_nose = 0;  ///< along the outline
  double shock = 0;      ///< distance of the bow shock
  double shock_mach = 0;
  double extent = 0;  ///< distance of the grid's outer boundary
};

/// s from -1 (end of the side y = -1) over 0 (nose) to 1 (end of the side y = 1).
Station station_at(double s, const BowShock& bow) {
  const double quarter = std::numbers::pi / 2;
  Station at;
  const double along = s * (side_length + quarter);
  at.from_nose = std::abs(along);
  if (at.from_nose <= quarter) {
    at.normal_x = -std::cos(along);
    at.normal_y = std::sin(along);
    at.x = at.normal_x;
    at.y = at.normal_y;
  } else {
    at.normal_y = along > 0 ? 1 : -1;
    at.x = at.from_nose - quarter;
    at.y = at.normal_y;
  }
  double inside = 0, outside = 40;
  for (int halving = 0; halving < 50; ++halving) {
    const double middle = 0.5 * (inside + outside);
    const bool behind = at.x + middle * at.normal_x > bow.x(at.y + middle * at.normal_y);
    (behind ? inside : outside) = middle;
  }
  at.shock = inside;
  at.shock_mach = bow.normal_mach(at.y + inside * at.normal_y);
  at.extent = 1.3 * at.shock + 1.7;
  return at;
}

struct Flow {
  double density = 1, pressure = free_pressure;
  std::array<double, 3> velocity{0, 0, 0};
};

/// 1 well nearer than `front`, 0 well beyond it.
double nearer(double distance, double front, double width) {
  return 0.5 * (1 + std::tanh((front - distance) / width));
}

/// Pressure and density outside of the boundary layers, before the vortex.
Flow inviscid(const Station& at, double d, double z) {
  const double width = 0.03 * at.extent;
  // Modified Newtonian pressure on the fin; the entropy is that behind the normal shock.
  const double stagnation = pitot();
  const double facing = std::max(0.0, -at.normal_x);
  const double body_pressure =
      blend(0.75, stagnation, square(facing)) * (1 - 0.1 * std::exp(-square(at.from_nose - 2)));
  const double stagnation_density = gamma * stagnation * free_pressure / total_sound2;
  const double body_density = stagnation_density * std::pow(body_pressure / stagnation, 1 / gamma);
  const double across = std::clamp(d / at.shock, 0.0, 1.0);
  const double layer = std::pow(across, 1.5);
  const double layer_pressure = blend(body_pressure, pressure_jump(at.shock_mach), layer);
  const double layer_density = blend(body_density, density_jump(at.shock_mach), layer);

  // At the plate the boundary layer separates ahead of the bow shock; the shock over the separated
  // flow meets the bow shock at a height of 1.3: a lambda.
  const double foot = std::max(0.0, 1 - z / 1.3);
  const double lead = nearer(d, at.shock + 1.3 * foot, width) * std::min(1.0, 3 * foot);
  const double fade = std::exp(-at.from_nose / 4);
  Flow flow;
  flow.pressure = blend(1, 1 + 1.3 * fade, lead);
  flow.density = blend(1, 1 + 0.75 * fade, lead);
  const double behind = nearer(d, at.shock * (1 - 0.25 * std::exp(-z / 0.5)), width);
  flow.pressure = free_pressure * blend(flow.pressure, layer_pressure, behind);
  flow.density = blend(flow.density, layer_density, behind);
  return flow;
}

/// Direction of the flow along the outline and away from it; unit length.
std::array<double, 2> direction(const Station& at, double d) {
  const double across = std::clamp(d / at.shock, 0.0, 1.0);
  const double through =
      blend(1, across * (0.2 + 0.8 * square(across)), nearer(d, at.shock, 0.03 * at.extent));
  // Tangent (-normal_y, normal_x) turned to point downstream; the flow towards the fin is damped.
  const double normal = at.normal_x * through;
  double x = 1 - at.normal_x * at.normal_x + normal * at.normal_x;
  double y = -at.normal_x * at.normal_y + normal * at.normal_y;
  // Behind the oblique part of the shock, the flow is turned outwards.
  y += 0.12 * at.normal_y * across * nearer(d, at.shock, 0.03 * at.extent);
  const double length = std::max(1e-6, std::hypot(x, y));
  return {x / length, y / length};
}

Flow flow_at(const Station& at, double d, double z) {
  Flow flow = inviscid(at, d, z);

  // The horseshoe vortex, wound around the fin's foot.
  const double core_d = 0.62 * at.shock + 0.35, core_z = 0.34 + 0.03 * at.from_nose;
  const double core = 0.30 + 0.03 * at.from_nose;
  const double strength = std::exp(-at.from_nose / 6);
  const double to_d = (d - core_d) / core, to_z = (z - core_z) / core;
  const double gauss = std::exp(-0.5 * (square(to_d) + square(to_z)));
  const double expansion = 1 - 0.5 * strength * gauss;
  flow.pressure *= expansion;
  flow.density *= std::pow(expansion, 1 / gamma);

  // Total enthalpy is that of the freestream: it gives the speed, and in the boundary layers the
  // temperature from the speed (Crocco and Busemann, recovery factor 0.9).
  double sound2 = gamma * flow.pressure / flow.density;
  const double speed = std::sqrt(std::max(0.0, 2 / (gamma - 1) * (total_sound2 - sound2)));
  const double slip = (1 - std::exp(-3 * z / 0.45)) * (1 - std::exp(-3 * d / 0.12));
  const double slow = speed * slip;
  sound2 += 0.9 * (gamma - 1) / 2 * (square(speed) - square(slow));
  flow.density = gamma * flow.pressure / sound2;

  const auto along = direction(at, d);
  const double swirl = 1.1 * strength * gauss * slip;
  flow.velocity = {slow * along[0] + swirl * to_z * at.normal_x,
                   slow * along[1] + swirl * to_z * at.normal_y, -swirl * to_d};
  return flow;
}

/// 0 to 1 with finer steps near 0.
double stretched(double t, double strength) {
  return std::sinh(strength * t) / std::sinh(strength);
}

}  // namespace

Mesh blunt_body(const GenerateOptions& options) {
  // Fewer than four cells would not go around the nose.
  const int cells = std::max(4, size_or(options, 63));
  const std::int64_t ni = std::int64_t{cells} + 1;
  const std::int64_t nj = std::max(std::int64_t{2}, 3 * ni / 4);
  const std::int64_t nk = nj;
  require_int32_ids(static_cast<double>(ni) * static_cast<double>(nj * nk), cells);

  const BowShock bow;
  std::vector<Station> stations;
  for (int i = 0; i <= cells; ++i) stations.push_back(station_at(2.0 * i / cells - 1, bow));

  const auto count =
      static_cast<std::size_t>(ni) * static_cast<std::size_t>(nj) * static_cast<std::size_t>(nk);
  std::vector<float> points, density, pressure, mach_number, velocity;
  for (auto* values : {&density, &pressure, &mach_number}) values->reserve(count);
  for (auto* values : {&points, &velocity}) values->reserve(3 * count);
  for (std::int64_t k = 0; k < nk; ++k) {
    const double z = height * stretched(static_cast<double>(k) / static_cast<double>(nk - 1), 2.2);
    for (std::int64_t j = 0; j < nj; ++j) {
      for (const Station& at : stations) {
        const double d =
            at.extent * stretched(static_cast<double>(j) / static_cast<double>(nj - 1), 1.8);
        points.push_back(static_cast<float>(at.x + d * at.normal_x));
        points.push_back(static_cast<float>(at.y + d * at.normal_y));
        points.push_back(static_cast<float>(z));
        const Flow flow = flow_at(at, d, z);
        density.push_back(static_cast<float>(flow.density));
        pressure.push_back(static_cast<float>(flow.pressure));
        const auto& v = flow.velocity;
        mach_number.push_back(static_cast<float>(std::hypot(v[0], v[1], v[2]) /
                                                 std::sqrt(gamma * flow.pressure / flow.density)));
        for (double component : v) velocity.push_back(static_cast<float>(component));
      }
    }
  }

  Mesh mesh;
  mesh.points = Array::own(std::move(points));
  mesh.dimensions = {ni, nj, nk};
  mesh.fields.push_back({"density", Association::point, 1, Array::own(std::move(density))});
  mesh.fields.push_back({"pressure", Association::point, 1, Array::own(std::move(pressure))});
  mesh.fields.push_back({"mach", Association::point, 1, Array::own(std::move(mach_number))});
  mesh.fields.push_back({"velocity", Association::point, 3, Array::own(std::move(velocity))});
  mesh.active_field = "density";
  return mesh;
}

}  // namespace plume::datasets
