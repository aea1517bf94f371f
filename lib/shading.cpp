#include "plume/lib/shading.h"

#include <fmt/format.h>

#include <cmath>

namespace plume {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Of length one, or nothing; however small or large the components are.
std::optional<Vector> unit(const Vector& v) {
  const double largest = std::fmax(std::abs(v[0]), std::fmax(std::abs(v[1]), std::abs(v[2])));
  if (!(largest > 0) || !std::isfinite(v[0] + v[1] + v[2])) return std::nullopt;
  const Vector scaled{v[0] / largest, v[1] / largest, v[2] / largest};
  const double length = std::sqrt(dot(scaled, scaled));
  return Vector{scaled[0] / length, scaled[1] / length, scaled[2] / length};
}

bool is_finite_and_not_negative(double value) { return std::isfinite(value) && value >= 0; }

}  // namespace

std::optional<std::string> Lighting::problem() const {
  for (const Light& light : lights) {
    if (!is_finite_and_not_negative(light.intensity))
      return fmt::format("a light of intensity {:g}; it must be finite and not negative",
                         light.intensity);
    if (light.direction && !unit(*light.direction))
      return fmt::format("a light from the direction {:g},{:g},{:g}; give it one of any length > 0",
                         (*light.direction)[0], (*light.direction)[1], (*light.direction)[2]);
  }
  if (!is_finite_and_not_negative(ambient))
    return fmt::format("an ambient share of {:g}; it must be finite and not negative", ambient);
  if (!is_finite_and_not_negative(diffuse))
    return fmt::format("a diffuse share of {:g}; it must be finite and not negative", diffuse);
  if (!is_finite_and_not_negative(specular))
    return fmt::format("a specular share of {:g}; it must be finite and not negative", specular);
  if (!(std::isfinite(exponent) && exponent > 0))
    return fmt::format("a specular exponent of {:g}; it must be finite and above 0", exponent);
  return std::nullopt;
}

Shading shading_of(const Lighting& lighting, const Vector& gradient, const Vector& direction) {
  auto normal = unit(gradient);
  if (!normal) return {};
  const Vector to_viewer{-direction[0], -direction[1], -direction[2]};
  if (dot(*normal, to_viewer) < 0) normal = Vector{-(*normal)[0], -(*normal)[1], -(*normal)[2]};
  double factor = lighting.ambient, highlight = 0;
  for (const Light& light : lighting.lights) {
    const Vector to_light = light.direction ? *unit(*light.direction) : to_viewer;
    const double facing = dot(*normal, to_light);
    if (!(facing > 0)) continue;
    factor += lighting.diffuse * light.intensity * facing;
    const auto half =
        unit({to_light[0] + to_viewer[0], to_light[1] + to_viewer[1], to_light[2] + to_viewer[2]});
    if (half)
      highlight += lighting.specular * light.intensity *
                   std::pow(std::fmax(0, dot(*normal, *half)), lighting.exponent);
  }
  return {static_cast<float>(factor), static_cast<float>(highlight)};
}

}  // namespace plume
