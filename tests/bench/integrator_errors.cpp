#include "plume/tests/bench/integrator_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "plume/preint/integrator.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/markdown_table.h"
#include "plume/tests/bench/segment_lanes.h"
#include "plume/tests/bench/timing.h"
#include "plume/tests/preint/transfer_functions.h"
#include "plume/tests/reference/adaptive_quadrature.h"

namespace plume::bench {
namespace {

constexpr int kDecades = 7;
constexpr std::array<float, 2> kScalars{0, 1}, kLengths{1e-4f, 1e3f};

std::vector<tests::NamedTransferFunction> six_functions() {
  auto functions = tests::all_functions();
  std::erase_if(functions, [](const auto& named) { return named.name == "single knot"; });
  return functions;
}

// All within tables over kScalars and kLengths. As many of each decade of length; of the ends half
// are anywhere, half near each other as in a mesh, and a tenth at a knot.
LaneSegments segments_of(const TransferFunction& function, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::normal_distribution<float> near(0, 0.02f);
  LaneSegments list;
  const auto add = [&](float s_in, float s_out, float length) {
    list.s_in.push_back(s_in);
    list.s_out.push_back(s_out);
    list.length.push_back(length);
  };
  const auto end = [&] {
    const std::size_t knot = random() % function.knots.size();
    return unit(random) < 0.1f ? std::clamp(function.knots[knot].scalar, 0.0f, 1.0f) : unit(random);
  };
  for (int i = 0; i < count; ++i) {
    const float exponent = static_cast<float>(i % kDecades - 4) + unit(random);
    const float s_in = end();
    const float s_out = i / kDecades % 2 == 0 ? end() : std::clamp(s_in + near(random), 0.0f, 1.0f);
    add(s_in, s_out, std::clamp(std::pow(10.0f, exponent), kLengths[0], kLengths[1]));
  }
  while (list.size() % LaneSegments::rays != 0) add(0.5f, 0.5f, 1);
  return list;
}

// The larger error; a NaN is the worst of all.
double worse(double a, double b) { return std::isnan(a) || b <= a ? a : b; }

struct Error {
  double largest = 0;
  double squares = 0;
  std::size_t count = 0;

  void add(const std::array<double, 4>& found, const reference::Radiance& exact) {
    const std::array<double, 4> right{exact.rgb[0], exact.rgb[1], exact.rgb[2], exact.alpha};
    for (std::size_t c = 0; c < 4; ++c) {
      const double off = std::abs(found[c] - right[c]);
      largest = worse(largest, off);
      squares += off * off;
      ++count;
    }
  }
  double rms() const { return std::sqrt(squares / static_cast<double>(count)); }
};

// One way to do all segments.
struct Method {
  std::string name;
  std::function<void(const LaneSegments&, LaneColors&)> integrate;
};

template <class Integrator>
Method one_by_one(std::string name, Integrator integrator) {
  auto shared = std::make_shared<const Integrator>(std::move(integrator));
  return {std::move(name), [shared](const LaneSegments& segments, LaneColors& colors) {
            for (std::size_t i = 0; i < segments.size(); ++i) {
              const SegmentColor c =
                  shared->integrate(segments.s_in[i], segments.s_out[i], segments.length[i]);
              colors.r[i] = c.r;
              colors.g[i] = c.g;
              colors.b[i] = c.b;
              colors.alpha[i] = c.alpha;
            }
          }};
}

TableSettings table_of(int scalars, int lengths) { return {scalars, lengths, kScalars, kLengths}; }

std::vector<Method> methods(const TransferFunction& function, bool quick) {
  std::vector<Method> list;
  list.push_back(one_by_one("closed form", ClosedForm(function)));
  list.push_back({"closed form, vectors",
                  [pieces = PieceTable(function)](const LaneSegments& s, LaneColors& c) {
                    closed_form_by_lanes(pieces, s, c);
                  }});
  for (const auto& [scalars, lengths] :
       {std::pair{32, 16}, {64, 32}, {128, 32}, {128, 64}, {256, 128}}) {
    if (quick && scalars > 64) break;
    list.push_back(one_by_one(fmt::format("table, {0} x {0} x {1}", scalars, lengths),
                              PreintegratedTable(function, table_of(scalars, lengths))));
  }
  for (const int samples : {1, 4, 16, 64})
    list.push_back(
        one_by_one(samples == 1 ? std::string("midpoint") : fmt::format("midpoints, {}", samples),
                   MidpointIntegrator(function, samples)));
  list.push_back(one_by_one("reference, 1e-9", AdaptiveIntegrator(function)));
  return list;
}

using Rows = std::vector<std::vector<std::string>>;

std::string scientific(double value) { return fmt::format("{:.1e}", value); }

}  // namespace

std::string integrator_errors(const IntegratorBenchOptions& options) {
  const auto functions = six_functions();
  std::vector<std::string> header{"integrator"};
  for (const auto& named : functions) header.push_back(named.name);
  Rows largest{header}, rms{header}, times{header}, decades;
  decades.push_back(header);
  decades.front().front() = "length";
  std::array<std::array<double, 2>, kDecades> none{};
  std::vector<std::array<std::array<double, 2>, kDecades>> by_decade;
  for (const auto& [name, function] : functions) {
    const LaneSegments segments = segments_of(function, options.segments, options.seed);
    std::vector<reference::Radiance> exact;
    for (std::size_t i = 0; i < segments.size(); ++i)
      exact.push_back(reference::integrate_linear(function, segments.s_in[i], segments.s_out[i],
                                                  segments.length[i], 1e-10));
    LaneColors colors;
    colors.resize(segments.size());
    const auto list = methods(function, options.quick);
    std::vector<std::function<void()>> tasks;
    by_decade.push_back(none);
    for (std::size_t m = 0; m < list.size(); ++m) {
      list[m].integrate(segments, colors);
      Error error;
      for (std::size_t i = 0; i < segments.size(); ++i) {
        const std::array<double, 4> found{colors.r[i], colors.g[i], colors.b[i], colors.alpha[i]};
        error.add(found, exact[i]);
        if (m > 1 || i >= static_cast<std::size_t>(options.segments)) continue;
        Error one;
        one.add(found, exact[i]);
        double& worst = by_decade.back()[i % kDecades][m];
        worst = worse(worst, one.largest);
      }
      if (largest.size() <= m + 1)
        for (Rows* rows : {&largest, &rms, &times}) rows->push_back({list[m].name});
      largest[m + 1].push_back(scientific(error.largest));
      rms[m + 1].push_back(scientific(error.rms()));
      tasks.push_back([&, m] { list[m].integrate(segments, colors); });
    }
    const auto seconds = take_turns(tasks, options.rounds);
    const double of_closed_form = median(seconds[0]);
    for (std::size_t m = 0; m < list.size(); ++m) {
      const double time = median(seconds[m]);
      times[m + 1].push_back(fmt::format("{:.0f} ({:.2f})",
                                         1e9 * time / static_cast<double>(segments.size()),
                                         time / of_closed_form));
    }
  }
  for (std::size_t d = 0; d < kDecades; ++d) {
    decades.push_back(
        {fmt::format("1e{:+d} to 1e{:+d}", static_cast<int>(d) - 4, static_cast<int>(d) - 3)});
    for (const auto& worst : by_decade)
      decades.back().push_back(scientific(worst[d][0]) + ", " + scientific(worst[d][1]));
  }
  return "### Largest error\n\n" + markdown_table(largest) + "\n### RMS error\n\n" +
         markdown_table(rms) + "\n### Time of a segment, nanoseconds (x closed form)\n\n" +
         markdown_table(times) +
         "\n### Closed form by length: largest error, one by one and by vectors\n\n" +
         markdown_table(decades);
}

}  // namespace plume::bench
