#include "plume/tests/bench/trilinear_field.h"

namespace plume::bench {

TrilinearField::TrilinearField(int points,
                               const std::function<double(const std::array<double, 3>&)>& field)
    : points_(points) {
  for (int z = 0; z < points; ++z)
    for (int y = 0; y < points; ++y)
      for (int x = 0; x < points; ++x)
        values_.push_back(static_cast<float>(
            field({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)})));
}

double TrilinearField::operator()(const std::array<double, 3>& p) const {
  std::array<int, 3> cell;
  std::array<double, 3> w;
  for (std::size_t a = 0; a < 3; ++a) {
    cell[a] = std::clamp(static_cast<int>(std::floor(p[a])), 0, points_ - 2);
    w[a] = p[a] - cell[a];
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::size_t index = 0;
    for (std::size_t a = 3; a-- > 0;) {
      const int high = corner >> a & 1;
      weight *= high ? w[a] : 1 - w[a];
      index = index * static_cast<std::size_t>(points_) + static_cast<std::size_t>(cell[a] + high);
    }
    sum += weight * values_[index];
  }
  return sum;
}

std::vector<double> voxel_borders(const FieldRay& ray, int points) {
  std::vector<double> places{0, ray.length};
  for (std::size_t a = 0; a < 3; ++a)
    for (int plane = 0; plane < points; ++plane) {
      const double t = (plane - ray.origin[a]) / ray.direction[a];
      if (t > 0 && t < ray.length) places.push_back(t);
    }
  std::sort(places.begin(), places.end());
  return places;
}

std::array<double, 4> color_of(const Compositor& sum) {
  return {sum.rgb[0], sum.rgb[1], sum.rgb[2], sum.alpha()};
}

}  // namespace plume::bench
