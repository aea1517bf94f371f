#include "plume/preint/optics_sum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "plume/preint/closed_form.h"

namespace plume {
namespace {

/// A node in (0, 1), which stands for -node as well, and its weight; the rule is for [-1, 1].
struct Node {
  double position;
  double weight;
};

constexpr std::array<Node, 4> kEightNodes{{
    {0.1834346424956498049, 0.3626837833783619830},
    {0.5255324099163289858, 0.3137066458778872873},
    {0.7966664774136267396, 0.2223810344533744705},
    {0.9602898564975362317, 0.1012285362903762592},
}};

/// exp(-40) is 4e-18.
constexpr double kInvisible = 40;

PreciseOptics between(const PreciseOptics& a, const PreciseOptics& b, double share) {
  PreciseOptics optics;
  optics.extinction = (1 - share) * a.extinction + share * b.extinction;
  for (std::size_t c = 0; c < 3; ++c)
    optics.color[c] = a.color[c] + share * (b.color[c] - a.color[c]);
  return optics;
}

}  // namespace

LinearOptics LinearOptics::part(double from, double to) const {
  return {from == 0 ? front : between(front, back, from),
          to == 1 ? back : between(front, back, to)};
}

bool LinearOptics::operator<(const LinearOptics& other) const {
  auto numbers = [](const LinearOptics& o) {
    return std::tie(o.front.extinction, o.back.extinction, o.front.color, o.back.color);
  };
  return numbers(*this) < numbers(other);
}

PreciseColor integrate_sum(std::span<const LinearOptics> media, double length) {
  if (media.size() == 1) return integrate_linear(media[0].front, media[0].back, length);
  double a = 0, b = 0;
  for (const LinearOptics& medium : media) {
    a += medium.front.extinction * length;
    b += medium.back.extinction * length;
  }
  if (!(a + b > 0)) return {};
  PreciseColor color;
  double from = 0;
  for (double before = 0; from < 1 && before < kInvisible;) {
    const double here = a + (b - a) * from, slope = b - a;
    const auto depth = [&](double width) { return width * (here + slope * width / 2); };
    double width = 1 - from;
    // Where extinction falls to nothing before the depth is 1, there is no root, nor a need of one.
    if (depth(width) > 1) width = std::min(width, 2 / (here + std::sqrt(here * here + 2 * slope)));
    std::array<double, 3> sum{0, 0, 0};
    const auto look = [&](double at, double weight) {
      const double u = from + at;
      const double seen = weight * std::exp(-depth(at));
      for (const LinearOptics& medium : media) {
        const PreciseOptics optics = between(medium.front, medium.back, u);
        const double emitted = seen * optics.extinction;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += emitted * optics.color[c];
      }
    };
    const double half = width / 2;
    for (const Node& node : kEightNodes) {
      look(half - half * node.position, half * node.weight);
      look(half + half * node.position, half * node.weight);
    }
    const double transparency = std::exp(-before);
    for (std::size_t c = 0; c < 3; ++c) color.rgb[c] += transparency * length * sum[c];
    before += depth(width);
    from += width;
  }
  color.alpha = -std::expm1(-(a + b) / 2);
  return color;
}

}  // namespace plume
