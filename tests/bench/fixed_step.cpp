#include "plume/tests/bench/fixed_step.h"

#include <fmt/format.h>

#include <limits>

namespace plume::bench {

KnotTable::KnotTable(const TransferFunction& transfer_function)
    : transfer_function_(transfer_function) {
  const auto& knots = transfer_function_.knots;
  const float width = knots.back().scalar - knots.front().scalar;
  if (!(width > 0)) return;  // all scalars are at one end or the other
  first_.resize(std::max<std::size_t>(1024, 4 * knots.size()));
  const auto buckets = static_cast<float>(first_.size());
  per_scalar_ = buckets / width;
  std::size_t below = 0;
  for (std::size_t bucket = 0; bucket < first_.size(); ++bucket) {
    const float low = knots.front().scalar + static_cast<float>(bucket) / per_scalar_;
    while (below + 2 < knots.size() && knots[below + 1].scalar <= low) ++below;
    first_[bucket] = below;
  }
}

std::array<double, 2> inside_of(const Bounds& bounds, const Ray& ray) {
  std::array<double, 2> t{0, std::numeric_limits<double>::infinity()};
  for (std::size_t a = 0; a < 3; ++a) {
    if (ray.direction[a] == 0) {
      if (ray.origin[a] < bounds.low[a] || ray.origin[a] > bounds.high[a]) return {0, 0};
      continue;
    }
    const double one = (bounds.low[a] - ray.origin[a]) / ray.direction[a];
    const double other = (bounds.high[a] - ray.origin[a]) / ray.direction[a];
    t[0] = std::max(t[0], std::min(one, other));
    t[1] = std::min(t[1], std::max(one, other));
  }
  return t;
}

std::vector<double> tried_steps(bool quick) {
  if (quick) return {2, 0.5, 0.125};
  return {4, 2, 1, 0.5, 0.25, 0.125, 0.0625};
}

std::string step_name(double step) {
  return step >= 1 ? fmt::format("step {:g} cell{}", step, step > 1 ? "s" : "")
                   : fmt::format("step 1/{:g} cell", 1 / step);
}

}  // namespace plume::bench
