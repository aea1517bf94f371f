/// How well ways to find roots do on random cubics.
#pragma once

#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "plume/tests/reference/root_finding.h"

namespace plume::reference {

/// A cubic, less a value, along a ray through a cell, and the first place where it is zero.
struct KnownCubic {
  CubicAlongRay<double> cubic;
  std::optional<double> root;
};

/// Through values at 0, 1/3, 2/3 and 1, which run from one random number to another and bend away
/// from the line by up to `bend` times that range.
inline std::vector<KnownCubic> random_cubics(int count, double bend, std::uint64_t seed = 17) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<KnownCubic> made;
  while (static_cast<int>(made.size()) < count) {
    const double a = value(random), d = value(random), away = bend * std::abs(d - a);
    const double b = a + (d - a) / 3 + away * value(random);
    const double c = d + (a - d) / 3 + away * value(random);
    const CubicAlongRay<double> f{{a, -5.5 * a + 9 * b - 4.5 * c + d,
                                   9 * a - 22.5 * b + 18 * c - 4.5 * d,
                                   -4.5 * a + 13.5 * b - 13.5 * c + 4.5 * d}};
    made.push_back({f, first_root(f)});
  }
  return made;
}

struct RootScore {
  int missed = 0;    ///< there is a root, and none was found
  int invented = 0;  ///< there is none, and one was found
  int far = 0;       ///< more than 0.01 of the segment from the first one
  double worst = 0;  ///< error of the others

  int wrong() const { return missed + invented + far; }
};

template <class Real>
CubicAlongRay<Real> rounded_to(const CubicAlongRay<double>& f) {
  return {{static_cast<Real>(f.c[0]), static_cast<Real>(f.c[1]), static_cast<Real>(f.c[2]),
           static_cast<Real>(f.c[3])}};
}

/// Of `find(CubicAlongRay<Real>)`, which returns a place or nothing.
template <class Real, class Find>
RootScore score_of(const std::vector<KnownCubic>& cubics, const Find& find) {
  RootScore score;
  for (const KnownCubic& known : cubics) {
    const auto found = find(rounded_to<Real>(known.cubic));
    if (!known.root && found) ++score.invented;
    if (known.root && !found) ++score.missed;
    if (!known.root || !found) continue;
    const double error = std::abs(static_cast<double>(*found) - *known.root);
    if (error > 0.01)
      ++score.far;
    else
      score.worst = std::fmax(score.worst, error);
  }
  return score;
}

}  // namespace plume::reference
