#include "brute_force.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plume::reference {
namespace {

using Point = std::array<long double, 3>;

Point minus(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {static_cast<long double>(a[0]) - b[0], static_cast<long double>(a[1]) - b[1],
          static_cast<long double>(a[2]) - b[2]};
}
long double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

std::vector<CellSpan> clip_tetrahedra(
    const std::vector<std::array<std::array<double, 3>, 4>>& tetrahedra,
    const std::array<double, 3>& origin, const std::array<double, 3>& direction, double shortest) {
  std::vector<CellSpan> spans;
  const Point d{direction[0], direction[1], direction[2]};
  for (std::size_t c = 0; c < tetrahedra.size(); ++c) {
    const auto& t = tetrahedra[c];
    long double enter = -std::numeric_limits<long double>::infinity();
    long double leave = std::numeric_limits<long double>::infinity();
    long double cosine_in = 1, cosine_out = 1;
    for (std::size_t f = 0; f < 4 && enter < leave; ++f) {
      const auto& a = t[(f + 1) % 4];
      Point normal = cross(minus(t[(f + 2) % 4], a), minus(t[(f + 3) % 4], a));
      if (dot(normal, minus(t[f], a)) > 0)
        for (long double& x : normal) x = -x;
      // Inside: dot(normal, origin + t d - a) <= 0.
      const long double offset = dot(normal, minus(origin, a));
      const long double slope = dot(normal, d);
      const long double cosine = std::abs(slope) / std::sqrt(dot(normal, normal));
      if (slope > 0 && -offset / slope < leave) {
        leave = -offset / slope;
        cosine_out = cosine;
      } else if (slope < 0 && -offset / slope > enter) {
        enter = -offset / slope;
        cosine_in = cosine;
      } else if (slope == 0 && offset > 0) {
        leave = enter;
      }
    }
    if (leave - enter > shortest)
      spans.push_back({c, static_cast<double>(enter), static_cast<double>(leave),
                       static_cast<double>(cosine_in), static_cast<double>(cosine_out)});
  }
  std::sort(spans.begin(), spans.end(),
            [](const CellSpan& a, const CellSpan& b) { return a.t_in < b.t_in; });
  return spans;
}

}  // namespace plume::reference
