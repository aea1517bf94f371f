#include "plume/tests/bench/scalar_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/scalar_field.h"
#include "plume/preint/scalar_polynomial.h"
#include "plume/tests/reference/isoparametric.h"

namespace plume::bench {

ScalarError scalar_error(const Mesh& mesh, const Scene& scene, const Camera& camera,
                         ScalarOrder order, int rays) {
  const ScalarField field = select_field(mesh);
  const CellReader cells(mesh);
  const double shortest =
      1e-3 * scene.bounds().diagonal() / std::cbrt(static_cast<double>(scene.cell_count()));
  const double range = static_cast<double>(field.high) - field.low;
  ScalarError error;
  double squares = 0;
  std::vector<std::uint32_t> ids;
  std::vector<std::array<double, 3>> points;
  std::vector<double> scalars;
  auto compare = [&](const Ray& ray, const Segment& segment) {
    if (segment.t_out - segment.t_in < shortest) return;
    cells.points(segment.cell, ids);
    points.clear();
    scalars.clear();
    for (const std::uint32_t id : ids) {
      points.push_back(point_at(mesh, id));
      scalars.push_back(field.values[id]);
    }
    for (const double share : {0.1, 0.3, 0.5, 0.75, 0.9}) {
      const double t = segment.t_in + share * (segment.t_out - segment.t_in);
      std::array<double, 3> place;
      for (std::size_t a = 0; a < 3; ++a) place[a] = ray.origin[a] + t * ray.direction[a];
      const auto truth = reference::isoparametric_scalar(static_cast<int>(cells.type(segment.cell)),
                                                         points, scalars, place);
      if (!truth) {
        ++error.unanswered;
        continue;
      }
      const double off = std::abs(scalar_at(segment, share) - *truth) / range;
      error.largest = std::max(error.largest, off);
      squares += off * off;
      ++error.samples;
    }
  };
  constexpr int kSize = 512;
  const PixelRays pixel_rays(camera, kSize, kSize);
  std::mt19937_64 random(5);
  for (int i = 0; i < rays; ++i) {
    const auto x = static_cast<double>(random() % kSize), y = static_cast<double>(random() % kSize);
    const Ray ray = pixel_rays(x + 0.5, y + 0.5);
    scene.trace(
        ray,
        [&](const Segment& segment) {
          compare(ray, segment);
          return true;
        },
        order);
  }
  error.rms = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(error.samples, 1)));
  return error;
}

}  // namespace plume::bench
