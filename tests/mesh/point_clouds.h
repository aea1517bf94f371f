/// Points for tests of tetrahedralization, from the harmless to the most degenerate.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace plume::test {

inline const std::vector<std::string>& cloud_names() {
  static const std::vector<std::string> names{"uniform", "on a sphere", "lattice", "clustered",
                                              "far away"};
  return names;
}

/// About `count` points, distinct; a lattice has the next cube's number of them.
inline std::vector<std::array<double, 3>> cloud(const std::string& name, int count) {
  std::mt19937_64 random(5);
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<std::array<double, 3>> points;
  if (name == "lattice") {
    const int n = static_cast<int>(std::ceil(std::cbrt(count)));
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) points.push_back({double(i), double(j), double(k)});
    return points;
  }
  for (int i = 0; i < count; ++i) {
    std::array<double, 3> p{unit(), unit(), unit()};
    if (name == "on a sphere") {
      const double z = 2 * p[0] - 1, r = std::sqrt(1 - z * z), angle = 6.283185307179586 * p[1];
      p = {r * std::cos(angle), r * std::sin(angle), z};
    } else if (name == "clustered") {
      const double size = std::exp(-15 * unit());
      p = {i % 7 + size * p[0], size * p[1], size * p[2]};
    } else if (name == "far away") {
      for (double& x : p) x += 1e7;
    }
    points.push_back(p);
  }
  return points;
}

}  // namespace plume::test
