#include "plume/tests/bench/regular_bench.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/camera.h"
#include "plume/mesh/rectilinear_axes.h"
#include "plume/mesh/validate.h"
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

// In random directions, towards random places in the unit cube.
std::vector<Ray> random_rays() {
  std::vector<Ray> rays;
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
  }
  return rays;
}

// A picture's, tile by tile.
std::vector<Ray> picture_rays(const Bounds& bounds) {
  constexpr int kSize = 256, kTile = 8;
  Camera camera = named_view("iso", bounds);
  orbit(camera, 3, 2);
  const PixelRays pixel_rays(camera, kSize, kSize);
  std::vector<Ray> rays;
  for (int y = 0; y < kSize; y += kTile)
    for (int x = 0; x < kSize; x += kTile)
      for (int i = 0; i < kTile * kTile; ++i)
        rays.push_back(pixel_rays(x + i % kTile + 0.5, y + i / kTile + 0.5));
  return rays;
}

// A regular grid in both forms.
struct Input {
  explicit Input(int edge) : size(edge) {
    const Mesh box = generate("box-rectilinear", {edge, 0, 1});
    const Bounds bounds = check_structure(box);
    const ScalarField field = select_field(box, {"waves", Association::point});
    regular.reset(new Form<RectilinearWalker>{make_walkable_rectilinear(box, field)});
    hexahedra.reset(new Form<GridWalker>{make_walkable_grid(with_points(box), field, bounds)});
    of_random = random_rays();
    of_picture = picture_rays(bounds);
  }

  int size;
  std::unique_ptr<Form<RectilinearWalker>> regular;
  std::unique_ptr<Form<GridWalker>> hexahedra;
  std::vector<Ray> of_random, of_picture;
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

// Hexahedra by packets: all first hits, then all rays of each axis. The cube is left once.
class PacketRays {
 public:
  PacketRays(const Form<GridWalker>& form, const std::vector<Ray>& rays)
      : form_(form), rays_(rays), frames_(rays.size()), lists_(rays.size()) {
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      frame_at_.push_back(&frames_[i]);
      list_at_.push_back(&lists_[i]);
    }
  }

  Walk walk() {
    Walk result;
    const double start = thread_seconds();
    for (std::size_t i = 0; i < frames_.size(); ++i) frames_[i].set(rays_[i], form_.mesh.frame);
    for (EntryList& list : lists_) list.clear();
    form_.boundary.first_entries(frame_at_, list_at_);
    std::vector<PacketIntegral> sums(frames_.size());
    for (int axis = 0; axis < 3; ++axis) {
      Feeder feeder(*this, axis);
      integrate_scalar(form_.mesh, axis, feeder, sums);
    }
    for (const PacketIntegral& sum : sums) {
      result.cells += sum.cells;
      result.length += static_cast<double>(sum.length);
      result.sum += 2 * static_cast<double>(sum.integral);
    }
    result.seconds = thread_seconds() - start;
    return result;
  }

 private:
  class Feeder : public PacketFeeder {
   public:
    Feeder(const PacketRays& rays, int axis) : rays_(rays), axis_(axis) {}

    const PacketStart* next(const PacketStart* finished) override {
      const WalkableGrid& mesh = rays_.form_.mesh;
      for (; at_ < rays_.frames_.size(); ++at_) {
        if (rays_.frames_[at_].axis() != axis_ || rays_.lists_[at_].size == 0) continue;
        const std::size_t lane =
            finished
                ? static_cast<std::size_t>(static_cast<const GridStart*>(finished) - starts_.data())
                : used_++;
        const Entry& entry = rays_.lists_[at_].entries[0];
        set_start(starts_[lane], mesh, rays_.frames_[at_], mesh.boundary[entry.boundary],
                  entry.place, entry.rank, static_cast<std::uint32_t>(at_));
        ++at_;
        return &starts_[lane];
      }
      return nullptr;
    }

   private:
    const PacketRays& rays_;
    const int axis_;
    std::array<GridStart, kMaxPacketLanes> starts_;
    std::size_t used_ = 0, at_ = 0;
  };

  const Form<GridWalker>& form_;
  const std::vector<Ray>& rays_;
  std::vector<ShearedFrame> frames_;
  std::vector<EntryList> lists_;
  std::vector<const ShearedFrame*> frame_at_;
  std::vector<EntryList*> list_at_;
};

void fail(benchmark::State& state, const std::string& what) {
  failed = true;
  std::fprintf(stderr, "plume_bench: regular grid: %s\n", what.c_str());
  state.SkipWithError(what.c_str());
}

void run(benchmark::State& state, int size, ScalarOrder order, bool of_picture) {
  const Input& input = input_of(size);
  const std::vector<Ray>& rays = of_picture ? input.of_picture : input.of_random;
  PacketRays packets(*input.hexahedra, rays);
  std::vector<double> ours, theirs, of_packets, ratios, to_packets;
  for (auto unused : state) {
    (void)unused;
    const Walk as_hexahedra = walk(rays, [&](const Ray& ray, const auto& visit) {
      return trace(input.hexahedra->mesh, input.hexahedra->boundary, ray, visit);
    });
    const Walk as_such = walk(rays, [&](const Ray& ray, const auto& visit) {
      return trace(input.regular->mesh, input.regular->boundary, ray, visit, order);
    });
    const Walk by_packets = packets.walk();
    benchmark::DoNotOptimize(as_such.inner);
    state.SetIterationTime(as_such.seconds);
    ours.push_back(as_such.rate());
    theirs.push_back(as_hexahedra.rate());
    of_packets.push_back(by_packets.rate());
    ratios.push_back(as_such.rate() / as_hexahedra.rate());
    to_packets.push_back(as_such.rate() / by_packets.rate());
    // Values at planes are the same for every order.
    auto differ = [&as_such](const Walk& other) {
      auto off = [](double a, double b) { return !(std::abs(a - b) <= 1e-5 * std::abs(b)); };
      return off(as_such.length, other.length) || off(as_such.sum, other.sum) ||
             off(as_such.cells, other.cells);
    };
    if (differ(as_hexahedra) || differ(by_packets)) {
      fail(state, "not what the walkers of hexahedra saw");
      return;
    }
  }
  state.counters["Mcells/s"] = median(ours);
  state.counters["hexahedra_Mcells/s"] = median(theirs);
  state.counters["packets_Mcells/s"] = median(of_packets);
  state.counters["ratio"] = median(ratios);
  state.counters["to_packets"] = median(to_packets);
  state.counters["bytes/point"] = static_cast<double>(input.regular->mesh.bytes()) /
                                  static_cast<double>(input.regular->mesh.point_count());
  if (order == ScalarOrder::linear && median(ratios) < kLeastRegularRatio)
    fail(state,
         fmt::format("walked at {:.2f} times the rate of hexahedra, at least {} are promised",
                     median(ratios), kLeastRegularRatio));
}

}  // namespace

void register_regular_benchmarks(int rounds) {
  struct Named {
    ScalarOrder order;
    bool of_picture;
    const char* name;
  };
  for (const int size : {64, 192})
    for (const Named& named : {Named{ScalarOrder::linear, false, "linear"},
                               Named{ScalarOrder::quadratic, false, "quadratic"},
                               Named{ScalarOrder::cubic, false, "cubic"},
                               Named{ScalarOrder::linear, true, "linear/picture"}})
      benchmark::RegisterBenchmark(fmt::format("walk/regular/{}/{}", size, named.name).c_str(),
                                   [size, named](benchmark::State& state) {
                                     run(state, size, named.order, named.of_picture);
                                   })
          ->UseManualTime()
          ->Iterations(rounds)
          ->Unit(benchmark::kMillisecond);
}

bool regular_bench_failed() { return failed; }

}  // namespace plume::bench
