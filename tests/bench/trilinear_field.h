/// Rays through a field that is trilinear between points, sampled as one likes, and what the exact
/// integral along them is: for tables of first and second order.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "plume/preint/adaptive_integrator.h"
#include "plume/preint/compositing.h"

namespace plume::bench {

/// Values at `points`^3 points, one voxel apart, from (0, 0, 0) on.
class TrilinearField {
 public:
  TrilinearField(int points, const std::function<double(const std::array<double, 3>&)>& field);

  /// Anywhere; beyond the points, as the outermost voxels go on.
  double operator()(const std::array<double, 3>& p) const;
  int points() const { return points_; }

 private:
  int points_;
  std::vector<float> values_;
};

/// In units of voxels.
struct FieldRay {
  std::array<double, 3> origin, direction;  ///< of length one
  double length;                            ///< from the origin to where it ends
  std::array<double, 3> at(double t) const {
    return {origin[0] + t * direction[0], origin[1] + t * direction[1],
            origin[2] + t * direction[2]};
  }
};

/// Where the ray goes from voxel to voxel, both ends included, in order.
std::vector<double> voxel_borders(const FieldRay& ray, int points);

/// What a ray sees, exactly, where the field is a cubic between any two of the places.
template <class Field>
std::array<double, 4> exact_color(const Field& field, const FieldRay& ray,
                                  const std::vector<double>& places,
                                  const AdaptiveIntegrator& integrator) {
  PreciseColor sum;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double from = places[i], width = places[i + 1] - from;
    const auto at = [&](double u) {
      // Not on the border itself, beyond which lies another voxel.
      return static_cast<float>(field(ray.at(from + std::clamp(u, 1e-9, 1 - 1e-9) * width)));
    };
    sum.add_behind(integrator.integrate_precisely(
        ScalarPolynomial::cubic(at(0), at(1.0 / 3), at(2.0 / 3), at(1)), width));
  }
  return {sum.rgb[0], sum.rgb[1], sum.rgb[2], sum.alpha};
}

std::array<double, 4> color_of(const Compositor& sum);

/// Over all channels of all rays that are added.
struct ColorError {
  double largest = 0, squares = 0;
  int count = 0;

  void add(const std::array<double, 4>& found, const std::array<double, 4>& right) {
    for (std::size_t c = 0; c < 4; ++c) {
      const double off = std::abs(found[c] - right[c]);
      largest = std::max(largest, off);
      squares += off * off;
      ++count;
    }
  }
  double rms() const { return std::sqrt(squares / count); }
};

}  // namespace plume::bench
