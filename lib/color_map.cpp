#include "plume/lib/color_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>

#include "plume/lib/color_space.h"
#include "plume/lib/srgb.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

/// An opacity of 1 would be an infinite extinction.
constexpr double most_opaque = 1 - 0x1p-24;

/// The promise is 1e-3 halfway between two knots; the rest is left for other places and for the
/// rounding to float.
constexpr double tolerance = 0.8e-3;

[[noreturn]] void fail(const ColorMap& map, const char* points, std::size_t index, double value,
                       const std::string& what) {
  std::ostringstream message;
  message << "colour map '" << map.name << "': " << points << " point " << index << ": " << what
          << ", but is " << value;
  throw Error(message.str());
}

template <class Points>
void check_ascending(const ColorMap& map, const char* what, const Points& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i].x;
    if (!std::isfinite(x)) fail(map, what, i, x, "x must be finite");
    if (i >= 1 && x < points[i - 1].x) fail(map, what, i, x, "x must ascend");
    // Two points at one place are a step; a third would have no meaning.
    if (i >= 2 && x == points[i - 2].x) fail(map, what, i, x, "x must differ from the two before");
  }
  if (points.size() < 2) {
    throw Error("colour map '" + map.name + "' has " + std::to_string(points.size()) + " " + what +
                " points; give at least 2");
  }
  if (!(points.front().x < points.back().x)) {
    fail(map, what, points.size() - 1, points.back().x, "x must be greater than the first");
  }
}

void check(const ColorMap& map) {
  const auto in_unit = [](double value) { return value >= 0 && value <= 1; };
  check_ascending(map, "colour", map.colors);
  for (std::size_t i = 0; i < map.colors.size(); ++i) {
    for (double c : map.colors[i].srgb) {
      if (!in_unit(c)) fail(map, "colour", i, c, "a colour must lie within 0 and 1");
    }
  }
  if (map.opacities.empty()) return;
  check_ascending(map, "opacity", map.opacities);
  for (std::size_t i = 0; i < map.opacities.size(); ++i) {
    const auto& point = map.opacities[i];
    if (!in_unit(point.opacity)) {
      fail(map, "opacity", i, point.opacity, "opacity must lie within 0 and 1");
    }
    if (!in_unit(point.midpoint)) {
      fail(map, "opacity", i, point.midpoint, "midpoint must lie within 0 and 1");
    }
    if (!in_unit(point.sharpness)) {
      fail(map, "opacity", i, point.sharpness, "sharpness must lie within 0 and 1");
    }
  }
}

// As in vtkPiecewiseFunction.
constexpr double step_sharpness = 0.99;
constexpr double linear_sharpness = 0.01;

double midpoint_of(const ColorMap::OpacityPoint& point) {
  return std::clamp(point.midpoint, 0.00001, 0.99999);
}

/// Opacity a fraction t of the way from a to b; vtkPiecewiseFunction's curve.
double interpolate_opacity(const ColorMap::OpacityPoint& a, const ColorMap::OpacityPoint& b,
                           double t) {
  const double midpoint = midpoint_of(a);
  double s = t < midpoint ? 0.5 * t / midpoint : 0.5 + 0.5 * (t - midpoint) / (1 - midpoint);
  if (a.sharpness > step_sharpness) return s < 0.5 ? a.opacity : b.opacity;
  if (a.sharpness < linear_sharpness) return (1 - s) * a.opacity + s * b.opacity;

  // Drawn towards the midpoint, then a Hermite cubic, whose ends are the flatter the sharper.
  const double power = 1 + 10 * a.sharpness;
  s = s < 0.5 ? 0.5 * std::pow(2 * s, power) : 1 - 0.5 * std::pow(2 * (1 - s), power);
  const double rise = b.opacity - a.opacity;
  const double slope = (1 - a.sharpness) * rise;
  const double value = a.opacity + rise * s * s * (3 - 2 * s) + slope * s * (2 * s * s - 3 * s + 1);
  return std::clamp(value, std::min(a.opacity, b.opacity), std::max(a.opacity, b.opacity));
}

/// The pair of points whose interval holds `x`: the index of the second, or 0 or size() beyond the
/// ends. `middle` is any place within a piece between breaks, so that no x equals a point's.
template <class Points>
std::size_t interval_of(const Points& points, double middle) {
  const auto after = std::upper_bound(points.begin(), points.end(), middle,
                                      [](double x, const auto& point) { return x < point.x; });
  return static_cast<std::size_t>(after - points.begin());
}

template <class Point>
double fraction(const Point& a, const Point& b, double x) {
  return std::clamp((x - a.x) / (b.x - a.x), 0.0, 1.0);
}

/// What a map shows at one place: linear colour and opacity over a unit distance.
struct Shown {
  double x = 0;
  std::array<double, 3> color{0, 0, 0};
  double opacity = 0;
};

/// A stretch of the map without a break: evaluated from within at both of its ends.
class Piece {
 public:
  Piece(const ColorMap& map, double low, double high) : map_(map), low_(low), high_(high) {
    const double middle = low + 0.5 * (high - low);
    color_ = interval_of(map.colors, middle);
    opacity_ = interval_of(map.opacities, middle);
  }

  double low() const { return low_; }
  double high() const { return high_; }

  Shown at(double x) const {
    Shown shown;
    shown.x = x;
    const auto& colors = map_.colors;
    std::array<double, 3> srgb = colors[std::min(color_, colors.size() - 1)].srgb;
    if (color_ > 0 && color_ < colors.size()) {
      const auto& a = colors[color_ - 1];
      const auto& b = colors[color_];
      srgb = interpolate(map_.space, a.srgb, b.srgb, fraction(a, b, x));
    }
    for (std::size_t c = 0; c < 3; ++c) shown.color[c] = srgb_to_linear(srgb[c]);
    shown.opacity = std::min(opacity_at(x), most_opaque);
    return shown;
  }

 private:
  double opacity_at(double x) const {
    const auto& points = map_.opacities;
    if (opacity_ == 0) return points.front().opacity;
    if (opacity_ == points.size()) return points.back().opacity;
    const auto& a = points[opacity_ - 1];
    const auto& b = points[opacity_];
    if (a.sharpness > step_sharpness) {
      // The jump lies between two pieces: ask which side this piece is on, not its end.
      x = low_ + 0.5 * (high_ - low_);
    }
    return interpolate_opacity(a, b, fraction(a, b, x));
  }

  const ColorMap& map_;
  double low_, high_;
  std::size_t color_ = 0, opacity_ = 0;
};

/// Where the map may jump or bend, in ascending order.
std::vector<double> breaks_of(const ColorMap& map) {
  std::vector<double> breaks;
  for (std::size_t i = 0; i < map.colors.size(); ++i) {
    breaks.push_back(map.colors[i].x);
    // A diverging map may turn at white, halfway.
    if (map.space == ColorMap::Space::diverging && i > 0) {
      breaks.push_back(0.5 * (map.colors[i - 1].x + map.colors[i].x));
    }
  }
  for (std::size_t i = 0; i < map.opacities.size(); ++i) {
    breaks.push_back(map.opacities[i].x);
    if (i > 0) {
      const auto& a = map.opacities[i - 1];
      breaks.push_back(a.x + midpoint_of(a) * (map.opacities[i].x - a.x));
    }
  }
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  return breaks;
}

class Resampling {
 public:
  Resampling(double unit_distance, double scale) : unit_distance_(unit_distance), scale_(scale) {}

  TransferFunction result() && { return std::move(result_); }

  void add(const Piece& piece) {
    const Shown low = piece.at(piece.low());
    const Shown high = piece.at(piece.high());
    add_knot(low);
    refine(piece, low, high, 0);
    add_knot(high);
  }

 private:
  /// Adds knots between two, not themselves.
  void refine(const Piece& piece, const Shown& low, const Shown& high, int depth) {
    // Where floats cannot tell the ends from the middle, no knot can help.
    const double middle = low.x + 0.5 * (high.x - low.x);
    const auto as_float = static_cast<float>(middle);
    if (as_float == static_cast<float>(low.x) || as_float == static_cast<float>(high.x)) return;
    constexpr int deepest = 24;
    if (depth == deepest || is_close(piece, low, high)) return;
    const Shown between = piece.at(middle);
    refine(piece, low, between, depth + 1);
    add_knot(between);
    refine(piece, between, high, depth + 1);
  }

  bool is_close(const Piece& piece, const Shown& low, const Shown& high) const {
    // Quarters as well as the half: a curve may cross its chord in the middle.
    for (double t : {0.125, 0.25, 0.5, 0.75, 0.875}) {
      const Shown exact = piece.at(low.x + t * (high.x - low.x));
      for (std::size_t c = 0; c < 3; ++c) {
        const double color = (1 - t) * low.color[c] + t * high.color[c];
        if (std::abs(color - exact.color[c]) > tolerance) return false;
      }
      const double depth = (1 - t) * optical_depth(low) + t * optical_depth(high);
      if (std::abs(-std::expm1(-depth) - exact.opacity) > tolerance) return false;
      // The scaled opacity is what will be seen.
      const double scaled =
          std::expm1(-scale_ * depth) - std::expm1(-scale_ * optical_depth(exact));
      if (std::abs(scaled) > tolerance) return false;
    }
    return true;
  }

  /// Over one unit distance, unscaled.
  static double optical_depth(const Shown& shown) { return -std::log1p(-shown.opacity); }

  void add_knot(const Shown& shown) {
    TransferFunction::Knot knot;
    knot.scalar = static_cast<float>(shown.x);
    knot.optics.extinction = static_cast<float>(optical_depth(shown) / unit_distance_ * scale_);
    for (std::size_t c = 0; c < 3; ++c) {
      knot.optics.color[c] = static_cast<float>(shown.color[c]);
    }
    auto& knots = result_.knots;
    if (!knots.empty() && knots.back().scalar == knot.scalar) {
      const Optics& last = knots.back().optics;
      if (last.extinction == knot.optics.extinction && last.color == knot.optics.color) return;
      // Of several knots at one place, the first and the last make the step.
      if (knots.size() >= 2 && knots[knots.size() - 2].scalar == knot.scalar) knots.pop_back();
    }
    knots.push_back(knot);
  }

  double unit_distance_, scale_;
  TransferFunction result_;
};

}  // namespace

ColorMap rescaled(ColorMap map, double low, double high) {
  check(map);
  if (!(low < high) || !std::isfinite(high - low)) {
    std::ostringstream message;
    message << "colour map '" << map.name << "': cannot be mapped onto [" << low << ", " << high
            << "]; give a finite range, its lower end first";
    throw Error(message.str());
  }
  double first = map.colors.front().x, last = map.colors.back().x;
  if (!map.opacities.empty()) {
    first = std::min(first, map.opacities.front().x);
    last = std::max(last, map.opacities.back().x);
  }
  const auto moved = [&](double x) {
    const double t = (x - first) / (last - first);
    // Both ends exactly.
    return t == 1 ? high : low + t * (high - low);
  };
  for (auto& point : map.colors) point.x = moved(point.x);
  for (auto& point : map.opacities) point.x = moved(point.x);
  return map;
}

TransferFunction to_transfer_function(const ColorMap& map, double unit_distance,
                                      double opacity_scale) {
  check(map);
  const auto require = [&](bool good, const char* what, double value) {
    if (good) return;
    std::ostringstream message;
    message << "colour map '" << map.name << "': " << what << " is " << value
            << "; give a finite number";
    throw Error(message.str());
  };
  require(unit_distance > 0 && std::isfinite(unit_distance), "unit distance (above 0)",
          unit_distance);
  require(opacity_scale >= 0 && std::isfinite(opacity_scale), "opacity scale (0 or above)",
          opacity_scale);

  ColorMap whole = map;
  if (whole.opacities.empty()) {
    whole.opacities = {{map.colors.front().x, 0}, {map.colors.back().x, 1}};
  }
  Resampling resampling(unit_distance, opacity_scale);
  const std::vector<double> breaks = breaks_of(whole);
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    resampling.add(Piece(whole, breaks[i - 1], breaks[i]));
  }
  TransferFunction function = std::move(resampling).result();
  if (const auto problem = function.problem()) {
    throw Error("colour map '" + map.name + "': in single precision, " + *problem +
                "; choose a wider range or a larger unit distance");
  }
  return function;
}

}  // namespace plume
