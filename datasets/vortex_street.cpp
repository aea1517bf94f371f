#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "plume/datasets/families.h"
#include "plume/datasets/grid.h"

// A picture of a flow, not a solution of it: vortices of Lamb and Oseen's profile, shed and spaced
// as published, are carried along and added up; the shear layers that feed them are drawn by hand.

namespace plume::datasets {
namespace {

// Lengths in diameters of the cylinder, speeds in that of the free stream.
constexpr double reynolds = 150;
/// Strouhal number 0.2 (A. Roshko, NACA report 1191, 1954).
constexpr double period = vortex_street_period;
constexpr double convection = 0.85;
constexpr double spacing = convection * period;  ///< of the vortices in a row
/// The stable ratio of the rows' distance to the spacing (Th. von Karman, 1911).
constexpr double row_distance = 0.281 * spacing;

constexpr double length = 14, half_width = 4, span = 6;
constexpr double formation = 1.0;     ///< vortices form so far behind the cylinder's axis
constexpr double growing_time = 1.8;  ///< and take this long to leave
constexpr double shear_layer = 0.14;

double square(double x) { return x * x; }

/// The circulation with which a street is carried along at that speed (Lamb, Hydrodynamics, 156).
double circulation() {
  return 2 * spacing * (1 - convection) / std::tanh(std::numbers::pi * row_distance / spacing);
}

struct Vortex {
  double x, y, strength, core2;
};

/// All vortices that the plane z sees at a time, well beyond the end of the grid.
std::vector<Vortex> vortices_at(double time, double z) {
  // Shedding is oblique (C. H. K. Williamson, J. Fluid Mech. 206, 1989), and the street gets waves
  // along the span (mode A, of about four diameters).
  const double lag = 0.12 * z;
  const double wave = std::sin(2 * std::numbers::pi * z / 4);
  std::vector<Vortex> vortices;
  for (const int side : {-1, 1}) {
    double age = std::fmod(time - lag + (side > 0 ? 0.5 * period : 0) + 2 * period, period);
    for (; age < 2 * length / convection; age += period) {
      const double left = 1 - std::exp(-age / growing_time);
      Vortex vortex{};
      vortex.x = formation + convection * (age - growing_time * left);
      vortex.y = side * (0.4 + (0.5 * row_distance - 0.4) * left);
      const double waviness = 0.02 * vortex.x;
      vortex.x += waviness * wave;
      vortex.y += side * 0.5 * waviness * wave;
      vortex.strength = -side * circulation() * left;
      vortex.core2 = square(0.35) + 4 * age / reynolds;
      vortices.push_back(vortex);
    }
  }
  return vortices;
}

struct Flow {
  double vorticity = 0;
  std::array<double, 3> velocity{1, 0, 0};
};

Flow flow_at(double x, double y, const std::vector<Vortex>& vortices) {
  Flow flow;
  for (const Vortex& vortex : vortices) {
    const double to_x = x - vortex.x, to_y = y - vortex.y;
    const double r2 = square(to_x) + square(to_y);
    const double gauss = std::exp(-r2 / vortex.core2);
    flow.vorticity += vortex.strength / (std::numbers::pi * vortex.core2) * gauss;
    const double turning = vortex.strength / (2 * std::numbers::pi) *
                           (r2 > 1e-12 ? (1 - gauss) / r2 : 1 / vortex.core2);
    flow.velocity[0] -= turning * to_y;
    flow.velocity[1] += turning * to_x;
  }
  for (const int side : {-1, 1})
    flow.vorticity += -side * 2.5 * std::exp(-square((y - side * 0.52) / shear_layer) - x / 0.7);
  // The speed vanishes on the cylinder, in a layer as thick as the shear layers.
  const double from_cylinder = std::max(0.0, std::hypot(x, y) - 0.5);
  const double slip = 1 - std::exp(-from_cylinder / shear_layer);
  for (double& component : flow.velocity) component *= slip;
  return flow;
}

/// Where the grid begins: on the cylinder's rear, or in the plane of its axis.
double first_x(double y) { return std::sqrt(std::max(0.0, 0.25 - square(y))); }

}  // namespace

Mesh vortex_street(const GenerateOptions& options) {
  const int cells = std::max(4, size_or(options, 72));
  const std::int64_t ni = std::int64_t{cells} + 1;
  const std::int64_t nj = std::int64_t{std::max(2, 2 * cells / 3)} + 1;
  const std::int64_t nk = std::int64_t{std::max(2, cells / 2)} + 1;
  require_int32_ids(static_cast<double>(ni) * static_cast<double>(nj * nk), cells);

  const auto at = [](double low, double high, std::int64_t i, std::int64_t n) {
    return low + (high - low) * static_cast<double>(i) / static_cast<double>(n - 1);
  };
  std::vector<float> points, vorticity, velocity;
  const auto count =
      static_cast<std::size_t>(ni) * static_cast<std::size_t>(nj) * static_cast<std::size_t>(nk);
  vorticity.reserve(count);
  for (auto* values : {&points, &velocity}) values->reserve(3 * count);
  for (std::int64_t k = 0; k < nk; ++k) {
    const double z = at(0, span, k, nk);
    const std::vector<Vortex> vortices = vortices_at(options.time, z);
    for (std::int64_t j = 0; j < nj; ++j) {
      const double y = at(-half_width, half_width, j, nj);
      for (std::int64_t i = 0; i < ni; ++i) {
        const double x = at(first_x(y), length, i, ni);
        for (const double coordinate : {x, y, z}) points.push_back(static_cast<float>(coordinate));
        const Flow flow = flow_at(x, y, vortices);
        vorticity.push_back(static_cast<float>(flow.vorticity));
        for (const double component : flow.velocity)
          velocity.push_back(static_cast<float>(component));
      }
    }
  }

  Mesh mesh;
  mesh.points = Array::own(std::move(points));
  mesh.dimensions = {ni, nj, nk};
  mesh.fields.push_back({"vorticity", Association::point, 1, Array::own(std::move(vorticity))});
  mesh.fields.push_back({"velocity", Association::point, 3, Array::own(std::move(velocity))});
  mesh.active_field = "vorticity";
  return mesh;
}

}  // namespace plume::datasets
