// A consumer of segments of one's own: an X-ray of a ball that is densest in its middle, and how
// long the ways through it are. Scene::trace hands over what a ray meets; what is made of it is up
// to the program.

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "plume/lib/plume.h"

// A ball of radius 1 as a grid in spherical coordinates, of density 1 - r.
plume::Mesh ball(int n) {
  std::vector<double> points, density;
  for (int k = 0; k <= 4 * n; ++k)
    for (int j = 0; j <= 2 * n; ++j)
      for (int i = 0; i <= n; ++i) {
        const double r = 1.0 * i / n, polar = std::numbers::pi * j / (2 * n);
        const double around = 2 * std::numbers::pi * (k % (4 * n)) / (4 * n);
        points.insert(points.end(), {r * std::sin(polar) * std::cos(around),
                                     r * std::sin(polar) * std::sin(around), r * std::cos(polar)});
        density.push_back(1 - r);
      }
  plume::Mesh mesh;
  mesh.dimensions = {n + 1, 2 * n + 1, 4 * n + 1};
  mesh.points = plume::Array::own(std::move(points));
  mesh.fields.push_back(
      {"density", plume::Association::point, 1, plume::Array::own(std::move(density))});
  return mesh;
}

int main() {
  const plume::Scene scene(ball(24));

  constexpr int kRows = 16, kColumns = 32, kRays = 300;
  std::array<int, 4> histogram{};  // of path lengths: up to 0.5, 1, 1.5, 2
  int hit = 0;
  for (int y = 0; y < kRays; ++y)
    for (int x = 0; x < kRays; ++x) {
      const plume::Ray ray{{-5, (x + 0.5) / kRays * 2 - 1, (y + 0.5) / kRays * 2 - 1}, {1, 0, 0}};
      double length = 0;
      scene.trace(ray, [&](const plume::Segment& segment) {
        length += segment.t_out - segment.t_in;
        return true;
      });
      if (length == 0) continue;
      ++hit;
      ++histogram[std::min<std::size_t>(3, static_cast<std::size_t>(length / 0.5))];
    }

  double middle = 0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const plume::Ray ray{{-5, (column + 0.5) / kColumns * 2 - 1, 1 - (row + 0.5) / kRows * 2},
                           {1, 0, 0}};
      double mass = 0;  // along the ray; the density is linear along each segment
      scene.trace(ray, [&](const plume::Segment& segment) {
        mass += 0.5 * (segment.s_in + segment.s_out) * (segment.t_out - segment.t_in);
        return true;
      });
      middle = std::max(middle, mass);
      std::putchar(" .:-=+*#%@"[static_cast<int>(9.99 * (1 - std::exp(-2 * mass)))]);
    }
    std::putchar('\n');
  }
  std::printf("most mass along a ray: %.2f\n", middle);
  std::printf("path lengths up to 0.5, 1, 1.5, 2:");
  for (const int count : histogram) std::printf(" %.1f%%", 100.0 * count / hit);
  std::putchar('\n');
  return 0;
}
