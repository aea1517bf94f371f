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
#include "plume/tests/bench/timing.h"
#include "plume/traverse/packets.h"
#include "plume/traverse/rectilinear_start.h"
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
      add_passage(ray);
    }
  }

  // Where hexahedra are entered is found beforehand; the box is convex.
  void add_passage(const Ray& ray) {
    ShearedFrame frame;
    frame.set(ray, hexahedra->mesh.frame);
    const GridWalker walker(hexahedra->mesh, frame);
    if (const auto entry = Entries<GridWalker>().first(hexahedra->boundary, walker, frame))
      passages[static_cast<std::size_t>(frame.axis())].push_back({ray, *entry});
  }

  struct Passage {
    Ray ray;
    Entry entry;
  };

  int size;
  std::unique_ptr<Form<RectilinearWalker>> regular;
  std::unique_ptr<Form<GridWalker>> hexahedra;
  std::vector<Ray> rays;
  std::array<std::vector<Passage>, 3> passages;  // by the rays' longest axis
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

// Starts are made when a lane asks for one, as in a renderer.
class RegularFeeder : public PacketFeeder {
 public:
  explicit RegularFeeder(const Input& input) : input_(input), lanes_(input.regular->mesh) {}

  const PacketStart* next(const PacketStart* finished) override {
    const std::size_t place = lanes_.place(finished);
    while (at_ < input_.rays.size()) {
      const std::size_t ray = at_++;
      if (lanes_.set(place, input_.rays[ray], static_cast<std::uint32_t>(ray)) ==
          RectilinearRay::ready)
        return lanes_.start(place);
    }
    return nullptr;
  }

 private:
  const Input& input_;
  RectilinearLanes lanes_;
  std::size_t at_ = 0;
};

class HexahedraFeeder : public PacketFeeder {
 public:
  HexahedraFeeder(const WalkableGrid& mesh, const std::vector<Input::Passage>& passages)
      : mesh_(mesh), passages_(passages) {}

  const PacketStart* next(const PacketStart* finished) override {
    if (at_ == passages_.size()) return nullptr;
    const std::size_t lane =
        finished
            ? static_cast<std::size_t>(static_cast<const GridStart*>(finished) - starts_.data())
            : used_++;
    const Input::Passage& passage = passages_[at_];
    frames_[lane].set(passage.ray, mesh_.frame);
    set_start(starts_[lane], mesh_, frames_[lane], mesh_.boundary[passage.entry.boundary],
              passage.entry.place, passage.entry.rank, static_cast<std::uint32_t>(at_++));
    return &starts_[lane];
  }

 private:
  const WalkableGrid& mesh_;
  const std::vector<Input::Passage>& passages_;
  std::array<GridStart, kMaxPacketLanes> starts_;
  std::array<ShearedFrame, kMaxPacketLanes> frames_;  // starts refer to them
  std::size_t used_ = 0, at_ = 0;
};

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
  std::vector<double> ours, theirs, ratios;
  for (auto unused : state) {
    (void)unused;
    const Walk as_hexahedra = walk_packets(input.rays.size(), sum, [&](const auto& add) {
      for (int axis = 0; axis < 3; ++axis) {
        HexahedraFeeder feeder(input.hexahedra->mesh,
                               input.passages[static_cast<std::size_t>(axis)]);
        add(input.hexahedra->mesh, axis, feeder);
      }
    });
    const Walk as_such = walk_packets(input.rays.size(), sum, [&](const auto& add) {
      RegularFeeder feeder(input);
      add(input.regular->mesh, feeder);
    });
    state.SetIterationTime(as_such.seconds);
    ours.push_back(as_such.rate());
    theirs.push_back(as_hexahedra.rate());
    ratios.push_back(as_such.rate() / as_hexahedra.rate());
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
