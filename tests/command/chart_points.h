// Points of charts at random, with ties in time, in error and in both.
#pragma once

#include <vector>

#include "plume/examples/plume/pareto.h"
#include "plume/tests/preint/seeded_rapidcheck.h"

namespace plume::tests {

inline command::ChartPoint any_point() {
  const auto power = [](int low, int high) {
    return static_cast<double>(*rc::gen::inRange(low, high));
  };
  const double error = power(0, 12);
  return {"way " + std::to_string(*rc::gen::inRange(0, 100)), "plume", 1 + power(0, 12), error,
          error / 3};
}

inline std::vector<command::ChartPoint> any_points(int most = 30) {
  const int count = *rc::gen::inRange(0, most);
  std::vector<command::ChartPoint> points;
  for (int i = 0; i < count; ++i) points.push_back(any_point());
  return points;
}

}  // namespace plume::tests
