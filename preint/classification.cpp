#include "plume/preint/classification.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace plume {

namespace {

// printf into a string; floats come as doubles.
[[gnu::format(printf, 1, 2)]] std::string line(const char* format, ...) {
  char text[320];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

std::optional<std::string> problem_of(const IntervalVolume& interval) {
  const double low = interval.low, high = interval.high;
  if (!std::isfinite(low) || !std::isfinite(high))
    return line("the interval [%g, %g] has an end that is not finite; give it two numbers", low,
                high);
  if (low == high)
    return line("the interval [%g, %g] has no width; make it an isosurface at %g", low, high, low);
  if (low > high)
    return line("the interval [%g, %g] ends below its start; write [%g, %g]", low, high, high, low);
  if (const auto problem = interval.profile.problem())
    return line("the profile of the interval [%g, %g]: %s", low, high, problem->c_str());
  for (const auto& knot : interval.profile.knots)
    if (!(knot.scalar >= 0 && knot.scalar <= 1))
      return line(
          "the profile of the interval [%g, %g] has a knot at w = %g; profiles run over 0 to 1, "
          "from the interval's low end to its high end",
          low, high, static_cast<double>(knot.scalar));
  return std::nullopt;
}

std::optional<std::string> problem_of(const Isosurface& surface) {
  const double value = surface.value, opacity = surface.opacity;
  if (!std::isfinite(value)) return line("the isovalue %g is not finite; give it a number", value);
  if (!(opacity >= 0 && opacity <= 1))
    return line("the isosurface at %g has an opacity of %g; it must be 0 to 1", value, opacity);
  for (const float channel : surface.color)
    if (!(std::isfinite(channel) && channel >= 0))
      return line("the isosurface at %g has a colour of %g; it must be finite and not negative",
                  value, static_cast<double>(channel));
  return std::nullopt;
}

}  // namespace

std::optional<std::string> Classification::problem() const {
  if (volume)
    if (const auto problem = volume->problem()) return problem;
  for (const IntervalVolume& interval : intervals)
    if (auto problem = problem_of(interval)) return problem;
  for (const Isosurface& surface : isosurfaces)
    if (auto problem = problem_of(surface)) return problem;

  std::vector<const IntervalVolume*> ascending;
  for (const IntervalVolume& interval : intervals) ascending.push_back(&interval);
  std::sort(ascending.begin(), ascending.end(), [](auto a, auto b) { return a->low < b->low; });
  for (std::size_t i = 1; i < ascending.size(); ++i) {
    const double low = ascending[i]->low, high = ascending[i]->high;
    const double low_before = ascending[i - 1]->low, before = ascending[i - 1]->high;
    if (!(low < before)) continue;
    if (low_before == low || high <= before) {
      // Of two that begin together the longer one comes first or second.
      const bool first_is_outer = before >= high;
      const double outer_low = first_is_outer ? low_before : low;
      const double outer_high = first_is_outer ? before : high;
      const double inner_low = first_is_outer ? low : low_before;
      const double inner_high = first_is_outer ? high : before;
      return line(
          "the interval [%g, %g] is nested in [%g, %g]; leave the inner one out, or cut the outer "
          "one at %g and %g",
          inner_low, inner_high, outer_low, outer_high, inner_low, inner_high);
    }
    return line(
        "the intervals [%g, %g] and [%g, %g] overlap; end the first at %g or start the second at "
        "%g",
        low_before, before, low, high, low, before);
  }
  std::vector<float> values;
  for (const Isosurface& surface : isosurfaces) values.push_back(surface.value);
  std::sort(values.begin(), values.end());
  const auto twice = std::adjacent_find(values.begin(), values.end());
  if (twice != values.end())
    return line("there are two isosurfaces at %g; leave one of them out",
                static_cast<double>(*twice));
  return std::nullopt;
}

TransferFunction even_profile(float opacity, const std::array<float, 3>& color) {
  const double seen = std::min<double>(opacity, 1 - 0x1p-24);
  return {{{0, {static_cast<float>(-std::log1p(-seen)), color}}}};
}

}  // namespace plume
