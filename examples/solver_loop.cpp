// A solver that is watched while it runs: its arrays are read where they are, the mesh is made
// ready once, and every ten steps a picture is taken of the values that the solver has by then.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "plume/lib/plume.h"

// Heat that spreads in a cube, from a hot middle: explicit steps on n x n x n points, between which
// lie tetrahedra, six a cube.
struct HeatSolver {
  int n;
  std::vector<double> points;
  std::vector<std::int64_t> tetrahedra;
  std::vector<double> temperature;

  explicit HeatSolver(int points_along) : n(points_along) {
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          points.insert(points.end(), {1.0 * i, 1.0 * j, 1.0 * k});
          const bool hot = std::max({std::abs(2 * i - n), std::abs(2 * j - n)}) < n / 2;
          temperature.push_back(hot && std::abs(2 * k - n) < n / 2 ? 1 : 0);
          if (std::max({i, j, k}) + 1 == n) continue;
          const std::int64_t corner = index(i, j, k), far = corner + 1 + n + n * n;
          for (const auto& [first, second] : {std::pair{1, 1 + n},
                                              {1 + n, n},
                                              {n, n + n * n},
                                              {n + n * n, n * n},
                                              {n * n, n * n + 1},
                                              {n * n + 1, 1}})
            tetrahedra.insert(tetrahedra.end(), {corner, corner + first, corner + second, far});
        }
  }
  std::int64_t index(int i, int j, int k) const { return i + std::int64_t{n} * (j + n * k); }

  void step() {
    const std::vector<double> before = temperature;
    for (int k = 1; k + 1 < n; ++k)
      for (int j = 1; j + 1 < n; ++j)
        for (int i = 1; i + 1 < n; ++i) {
          const auto at = static_cast<std::size_t>(index(i, j, k));
          double sum = -6 * before[at];
          for (const std::size_t step : {1, n, n * n}) sum += before[at - step] + before[at + step];
          temperature[at] = before[at] + 0.1 * sum;
        }
  }
};

int main() {
  HeatSolver solver(20);

  plume::Mesh mesh;
  mesh.points = plume::Array::borrow<double>(solver.points);
  mesh.cells.types = plume::Array::own(std::vector<std::uint8_t>{10});
  mesh.cells.connectivity = plume::Array::borrow<std::int64_t>(solver.tetrahedra);
  mesh.fields.push_back({"temperature", plume::Association::point, 1,
                         plume::Array::borrow<double>(solver.temperature)});

  plume::SceneOptions options;
  options.keep_field_order = true;
  plume::Scene scene(mesh, options);
  // The same colours for all pictures, whatever values there are by then.
  const plume::ColorMap map = plume::rescaled(*plume::preset("inferno"), 0, 1);
  scene.set_transfer_function(plume::to_transfer_function(map, 5));

  plume::RenderSettings settings;
  settings.width = settings.height = 64;
  const plume::Camera camera = plume::named_view("iso", scene.bounds());
  for (int step = 0; step <= 30; ++step) {
    if (step % 10 == 0) {
      scene.set_field(mesh);  // nothing is rebuilt but what depends on the values
      const plume::Image image = plume::render(scene, camera, settings).image;
      std::printf("step %2d: at most %.3f, the middle pixel is %.3f opaque\n", step,
                  static_cast<double>(scene.field().high),
                  static_cast<double>(image.pixel(32, 32)[3]));
    }
    solver.step();
  }
  return 0;
}
