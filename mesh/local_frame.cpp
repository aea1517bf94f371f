#include "plume/mesh/local_frame.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <limits>

#include "plume/mesh/error.h"

namespace plume {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

struct Partial {
  Bounds bounds{{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                 std::numeric_limits<double>::infinity()},
                {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                 -std::numeric_limits<double>::infinity()}};
  std::size_t first_bad = kNone;
};

}  // namespace

Bounds bounds_of(const Array& points) {
  const std::size_t count = points.size() / 3;
  if (count == 0) throw Error("the mesh has no points");
  return points.visit([&](auto values) {
    const Partial whole = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, count), Partial{},
        [&](const auto& range, Partial part) {
          for (std::size_t i = range.begin(); i != range.end(); ++i) {
            for (std::size_t a = 0; a < 3; ++a) {
              const double x = static_cast<double>(values[3 * i + a]);
              if (!std::isfinite(x)) part.first_bad = std::min(part.first_bad, i);
              part.bounds.low[a] = std::min(part.bounds.low[a], x);
              part.bounds.high[a] = std::max(part.bounds.high[a], x);
            }
          }
          return part;
        },
        [](Partial a, const Partial& b) {
          for (std::size_t i = 0; i < 3; ++i) {
            a.bounds.low[i] = std::min(a.bounds.low[i], b.bounds.low[i]);
            a.bounds.high[i] = std::max(a.bounds.high[i], b.bounds.high[i]);
          }
          a.first_bad = std::min(a.first_bad, b.first_bad);
          return a;
        });
    if (whole.first_bad != kNone)
      throw Error(fmt::format(
          "point {} is at ({}, {}, {}): coordinates must be finite; remove or repair the point",
          whole.first_bad, static_cast<double>(values[3 * whole.first_bad]),
          static_cast<double>(values[3 * whole.first_bad + 1]),
          static_cast<double>(values[3 * whole.first_bad + 2])));
    return whole.bounds;
  });
}

}  // namespace plume
