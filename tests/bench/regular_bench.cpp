#include "plume/tests/bench/regular_bench.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/mesh/rectilinear_axes.h"
#include "plume/mesh/validate.h"
#include "plume/tests/bench/regular_feeders.h"
#include "plume/tests/bench/timing.h"
#include "plume/traverse/packets.h"
#include "plume/traverse/trace_rectilinear.h"

namespace plume::bench {
namespace {

bool failed = false;

template <class Walker>
struct Form {
  typename Walker::Mesh mesh;
  BoundaryIndex<Walker> boundary{mesh};
};

// A regular grid in both forms, and rays towards places in it.
struct Input {
  explicit Input(int edge) : size(edge) {
    const Mesh box = generate("box-rectilinear", {edge, 0, 1});
    const Bounds bounds = check_structure(box);
    const ScalarField field = select_field(box, {"waves", Association::point});
    regular.reset(new Form<RectilinearWalker>{make_walkable_rectilinear(box, field)});
    hexahedra.reset(new Form<GridWalker>{make_walkable_grid(with_points(box), field, bounds)});
    std::mt19937_64 random(1);
    auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    for (int i = 0; i < 10000; ++i) {
      Ray ray;
      double length = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        ray.origin[a] = 4 * uniform() - 1.5;
        ray.direction[a] = uniform() - ray.origin[a];
        length += ray.direction[a] * ray.direction[a];
      }
      for (double& x : ray.direction) x /= std::sqrt(length);
      ray.t_min = -std::numeric_limits<double>::infinity();
      rays.push_back(ray);
      rays_of_axis[static_cast<std::size_t>(longest_axis(ray.direction))].push_back(ray);
    }
  }

  int size;
  std::unique_ptr<Form<RectilinearWalker>> regular;
  std::unique_ptr<Form<GridWalker>> hexahedra;
  std::vector<Ray> rays;
  std::array<std::vector<Ray>, 3> rays_of_axis;  // the same by their longest axis
};

// The one that is in memory: benchmarks run in the order in which they are registered.
const Input& input_of(int size) {
  static std::unique_ptr<Input> current;
  if (!current || current->size != size) {
    current.reset();
    current = std::make_unique<Input>(size);
  }
  return *current;
}

struct Walk {
  double seconds = 0, cells = 0, length = 0, sum = 0;
  float inner = 0;  // so that values inside of cells are not left out

  double rate() const { return 1e-6 * cells / seconds; }
};

// `follow(ray, visit)` traces one ray.
template <class Follow>
Walk walk(const std::vector<Ray>& rays, const Follow& follow) {
  Walk result;
  const double start = thread_seconds();
  for (const Ray& ray : rays) {
    const TraceResult trace = follow(ray, [&result](const Segment& s) {
      const double length = s.t_out - s.t_in;
      result.length += length;
      result.inner += s.inner[0] + s.inner[1];
      result.sum += length * (static_cast<double>(s.s_in) + static_cast<double>(s.s_out));
      return true;
    });
    result.cells += static_cast<double>(trace.cells);
  }
  result.seconds = thread_seconds() - start;
  return result;
}

void fail(benchmark::State& state, const std::string& what) {
  failed = true;
  std::fprintf(stderr, "plume_bench: regular grid: %s\n", what.c_str());
  state.SkipWithError(what.c_str());
}

void run(benchmark::State& state, int size, ScalarOrder order) {
  const Input& input = input_of(size);
  std::vector<double> ours, theirs, ratios;
  for (auto unused : state) {
    (void)unused;
    const Walk as_hexahedra = walk(input.rays, [&](const Ray& ray, const auto& visit) {
      return trace(input.hexahedra->mesh, input.hexahedra->boundary, ray, visit);
    });
    const Walk as_such = walk(input.rays, [&](const Ray& ray, const auto& visit) {
      return trace(input.regular->mesh, input.regular->boundary, ray, visit, order);
    });
    benchmark::DoNotOptimize(as_such.inner);
    state.SetIterationTime(as_such.seconds);
    ours.push_back(as_such.rate());
    theirs.push_back(as_hexahedra.rate());
    ratios.push_back(as_such.rate() / as_hexahedra.rate());
    // Values at planes are the same for every order.
    auto differ = [](double a, double b) { return !(std::abs(a - b) <= 1e-5 * std::abs(b)); };
    if (differ(as_such.length, as_hexahedra.length) || differ(as_such.sum, as_hexahedra.sum) ||
        differ(as_such.cells, as_hexahedra.cells)) {
      fail(state, "not what the walker of hexahedra saw");
      return;
    }
  }
  state.counters["Mcells/s"] = median(ours);
  state.counters["hexahedra_Mcells/s"] = median(theirs);
  state.counters["ratio"] = median(ratios);
  state.counters["bytes/point"] = static_cast<double>(input.regular->mesh.bytes()) /
                                  static_cast<double>(input.regular->mesh.point_count());
  if (order == ScalarOrder::linear && median(ratios) < kLeastRegularRatio)
    fail(state,
         fmt::format("walked at {:.2f} times the rate of hexahedra, at least {} are promised",
                     median(ratios), kLeastRegularRatio));
}

enum class Sum { cells, integral };

// `packets(add)` calls add() for each feeder, with the mesh that its rays go through.
template <class Packets>
Walk walk_packets(std::size_t rays, Sum sum, const Packets& packets) {
  std::vector<std::uint32_t> counts(rays, 0);
  std::vector<PacketIntegral> integrals(rays);
  Walk result;
  const double start = thread_seconds();
  if (sum == Sum::cells)
    packets([&](auto&&... to_walk) { count_cells(to_walk..., counts); });
  else
    packets([&](auto&&... to_walk) { integrate_scalar(to_walk..., integrals); });
  result.seconds = thread_seconds() - start;
  for (std::size_t i = 0; i < rays; ++i) {
    result.cells += counts[i] + integrals[i].cells;
    result.length += integrals[i].length;
    result.sum += 2 * integrals[i].integral;  // as walk() adds up
  }
  return result;
}

void run_packets(benchmark::State& state, int size, Sum sum) {
  const Input& input = input_of(size);
  std::vector<double> ours, theirs, ratios, ratios_inside;
  for (auto unused : state) {
    (void)unused;
    const Form<GridWalker>& hexahedra = *input.hexahedra;
    const double start = thread_seconds();
    std::array<std::unique_ptr<HexahedraFeeder>, 3> feeders;
    for (std::size_t axis = 0; axis < 3; ++axis)
      feeders[axis] = std::make_unique<HexahedraFeeder>(hexahedra.mesh, hexahedra.boundary,
                                                        input.rays_of_axis[axis]);
    const double entering = thread_seconds() - start;
    Walk as_hexahedra = walk_packets(input.rays.size(), sum, [&](const auto& add) {
      for (int axis = 0; axis < 3; ++axis)
        add(hexahedra.mesh, axis, *feeders[static_cast<std::size_t>(axis)]);
    });
    const double rate_inside = as_hexahedra.rate();
    as_hexahedra.seconds += entering;
    const Walk as_such = walk_packets(input.rays.size(), sum, [&](const auto& add) {
      RegularFeeder feeder(input.regular->mesh, input.rays);
      add(input.regular->mesh, feeder);
    });
    state.SetIterationTime(as_such.seconds);
    ours.push_back(as_such.rate());
    theirs.push_back(as_hexahedra.rate());
    ratios.push_back(as_such.rate() / as_hexahedra.rate());
    ratios_inside.push_back(as_such.rate() / rate_inside);
    auto differ = [](double a, double b) { return !(std::abs(a - b) <= 1e-5 * std::abs(b)); };
    if (differ(as_such.length, as_hexahedra.length) || differ(as_such.sum, as_hexahedra.sum) ||
        differ(as_such.cells, as_hexahedra.cells)) {
      fail(state, "packets saw not what those of hexahedra did");
      return;
    }
  }
  state.counters["Mcells/s"] = median(ours);
  state.counters["hexahedra_Mcells/s"] = median(theirs);
  state.counters["ratio"] = median(ratios);
  state.counters["ratio_inside"] = median(ratios_inside);
  if (median(ratios) < kLeastRegularRatio)
    fail(state,
         fmt::format("packets at {:.2f} times the rate of hexahedra's, at least {} are promised",
                     median(ratios), kLeastRegularRatio));
}

}  // namespace

void register_regular_benchmarks(int rounds) {
  struct Named {
    ScalarOrder order;
    const char* name;
  };
  for (const int size : {64, 192})
    for (const Named& named :
         {Named{ScalarOrder::linear, "linear"}, Named{ScalarOrder::quadratic, "quadratic"},
          Named{ScalarOrder::cubic, "cubic"}})
      benchmark::RegisterBenchmark(
          fmt::format("walk/regular/{}/{}", size, named.name).c_str(),
          [size, named](benchmark::State& state) { run(state, size, named.order); })
          ->UseManualTime()
          ->Iterations(rounds)
          ->Unit(benchmark::kMillisecond);
  struct NamedSum {
    Sum sum;
    const char* name;
  };
  for (const int size : {64, 192})
    for (const NamedSum& named :
         {NamedSum{Sum::cells, "cells"}, NamedSum{Sum::integral, "integral"}})
      benchmark::RegisterBenchmark(
          fmt::format("walk/regular/{}/packets/{}", size, named.name).c_str(),
          [size, named](benchmark::State& state) { run_packets(state, size, named.sum); })
          ->UseManualTime()
          ->Iterations(rounds)
          ->Unit(benchmark::kMillisecond);
}

bool regular_bench_failed() { return failed; }

}  // namespace plume::bench
