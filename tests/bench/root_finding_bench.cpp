// The ways to intersect a cell with an isosurface of tests/preint/root_finding_test.cpp: time for
// one, and how they do on the same cubics.

#include <benchmark/benchmark.h>

#include <vector>

#include "plume/preint/scalar_polynomial.h"
#include "plume/tests/reference/root_scores.h"

namespace plume::bench {
namespace {

using reference::CubicAlongRay;

template <class Real, class Find>
void time_roots(benchmark::State& state, double bend, const Find& find) {
  const auto cubics = reference::random_cubics(20000, bend);
  std::vector<CubicAlongRay<Real>> given;
  for (const auto& known : cubics) given.push_back(reference::rounded_to<Real>(known.cubic));
  for (auto _ : state)
    for (const auto& cubic : given) benchmark::DoNotOptimize(find(cubic));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(given.size()));
  const auto score = reference::score_of<Real>(cubics, find);
  state.counters["missed"] = score.missed;
  state.counters["invented"] = score.invented;
  state.counters["far"] = score.far;
  state.counters["worst"] = score.worst;
}

std::optional<double> ours(const CubicAlongRay<double>& f) {
  auto at = [&](double u) { return static_cast<float>(f(u)); };
  const auto p = ScalarPolynomial::cubic(at(0), at(1.0 / 3), at(2.0 / 3), at(1));
  double from = 0;
  for (const double to : p.extrema()) {
    if (p(from) * p(to) <= 0) return p.place_of(0, from, to);
    from = to;
  }
  if (p(from) * p(1) <= 0) return p.place_of(0, from, 1);
  return std::nullopt;
}

[[maybe_unused]] const bool registered = [] {
  for (const double bend : {0.25, 2.0}) {
    const std::string name = bend < 1 ? "roots/mild/" : "roots/bent/";
    auto add = [&]<class Real>(const char* method, Real, const auto& find) {
      benchmark::RegisterBenchmark((name + method).c_str(), [bend, find](benchmark::State& state) {
        time_roots<Real>(state, bend, find);
      });
    };
    add("midpoint", 0.0f, [](const auto& f) { return reference::midpoint_root(f); });
    add("linear", 0.0f, [](const auto& f) { return reference::linear_root(f); });
    add("repeated-linear", 0.0f,
        [](const auto& f) { return reference::repeated_linear_root(f, 3); });
    add("closed-form-single", 0.0f, [](const auto& f) { return reference::analytic_root(f); });
    add("closed-form-double", 0.0, [](const auto& f) { return reference::analytic_root(f); });
    add("isolated", 0.0f, [](const auto& f) { return reference::isolated_root(f, 3); });
    add("ours", 0.0, ours);
  }
  return true;
}();

}  // namespace
}  // namespace plume::bench
