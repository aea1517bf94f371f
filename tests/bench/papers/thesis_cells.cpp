// The thesis' table 4.5: ways to intersect a voxel with an isosurface.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "plume/mesh/error.h"
#include "plume/preint/scalar_polynomial.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/markdown_table.h"
#include "plume/tests/bench/papers/paper_tables.h"
#include "plume/tests/bench/papers/stand_in_fields.h"
#include "plume/tests/bench/timing.h"
#include "plume/tests/reference/root_scores.h"

namespace plume::bench {
namespace {

using reference::CubicAlongRay;

// A ray's way through a voxel that has corners on both sides of an isovalue.
struct VoxelCrossing {
  std::array<float, 8> corners;  // less the isovalue, x fastest
  std::array<float, 3> in, out;  // in the voxel's unit cube
};

// The values of the cubic at 0 and 1, and its coefficients (equation 4.4), by one axis after the
// other.
template <class Real>
CubicAlongRay<Real> cubic_of(const VoxelCrossing& voxel) {
  const auto in = [&](std::size_t a) { return static_cast<Real>(voxel.in[a]); };
  const auto step = [&](std::size_t a) { return static_cast<Real>(voxel.out[a]) - in(a); };
  std::array<std::array<Real, 2>, 4> along_x;
  for (std::size_t e = 0; e < 4; ++e) {
    const Real low = static_cast<Real>(voxel.corners[2 * e]);
    const Real rise = static_cast<Real>(voxel.corners[2 * e + 1]) - low;
    along_x[e] = {low + rise * in(0), rise * step(0)};
  }
  std::array<std::array<Real, 3>, 2> along_y;
  for (std::size_t e = 0; e < 2; ++e) {
    const auto& low = along_x[2 * e];
    const Real rise0 = along_x[2 * e + 1][0] - low[0], rise1 = along_x[2 * e + 1][1] - low[1];
    along_y[e] = {low[0] + rise0 * in(1), low[1] + rise1 * in(1) + rise0 * step(1),
                  rise1 * step(1)};
  }
  const auto& low = along_y[0];
  std::array<Real, 3> rise;
  for (std::size_t i = 0; i < 3; ++i) rise[i] = along_y[1][i] - low[i];
  return {{low[0] + rise[0] * in(2), low[1] + rise[1] * in(2) + rise[0] * step(2),
           low[2] + rise[2] * in(2) + rise[1] * step(2), rise[2] * step(2)}};
}

float trilinear(const VoxelCrossing& voxel, float u) {
  std::array<float, 3> p;
  for (std::size_t a = 0; a < 3; ++a) p[a] = voxel.in[a] + u * (voxel.out[a] - voxel.in[a]);
  std::array<float, 4> along_x;
  for (std::size_t e = 0; e < 4; ++e)
    along_x[e] = voxel.corners[2 * e] + p[0] * (voxel.corners[2 * e + 1] - voxel.corners[2 * e]);
  const float low = along_x[0] + p[1] * (along_x[1] - along_x[0]);
  return low + p[2] * (along_x[2] + p[1] * (along_x[3] - along_x[2]) - low);
}

// Of rays in random directions through a grid of points, `count` crossings of voxels that have
// corners on both sides.
std::vector<VoxelCrossing> crossings_of(const Mesh& grid, float isovalue, std::size_t count) {
  const auto at = [&grid](const std::array<int, 3>& p) {
    return static_cast<std::size_t>(p[0] + grid.dimensions[0] * (p[1] + grid.dimensions[1] * p[2]));
  };
  std::vector<float> values(grid.point_count());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = grid.fields[0].values.at<float>(i);
  std::mt19937_64 random(1);
  const auto unit = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<VoxelCrossing> made;
  for (int ray = 0; made.size() < count && ray < 1000000; ++ray) {
    // From a side of the box to the one across, in units of voxels.
    std::array<double, 3> from, to;
    const std::size_t axis = static_cast<std::size_t>(ray) % 3;
    for (std::size_t a = 0; a < 3; ++a) {
      const double cells = static_cast<double>(grid.dimensions[a] - 1);
      from[a] = a == axis ? 0 : cells * unit();
      to[a] = a == axis ? cells : cells * unit();
    }
    std::vector<double> places{0, 1};
    for (std::size_t a = 0; a < 3; ++a)
      for (int plane = 0; plane < grid.dimensions[a]; ++plane) {
        const double t = (plane - from[a]) / (to[a] - from[a]);
        if (t > 0 && t < 1) places.push_back(t);
      }
    std::sort(places.begin(), places.end());
    for (std::size_t i = 0; i + 1 < places.size() && made.size() < count; ++i) {
      VoxelCrossing voxel;
      std::array<int, 3> cell;
      for (std::size_t a = 0; a < 3; ++a) {
        const double in = from[a] + places[i] * (to[a] - from[a]);
        const double out = from[a] + places[i + 1] * (to[a] - from[a]);
        cell[a] = std::clamp(static_cast<int>((in + out) / 2), 0,
                             static_cast<int>(grid.dimensions[a]) - 2);
        voxel.in[a] = static_cast<float>(std::clamp(in - cell[a], 0.0, 1.0));
        voxel.out[a] = static_cast<float>(std::clamp(out - cell[a], 0.0, 1.0));
      }
      for (int c = 0; c < 8; ++c)
        voxel.corners[static_cast<std::size_t>(c)] =
            values[at({cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2)})] - isovalue;
      const auto [least, most] = std::minmax_element(voxel.corners.begin(), voxel.corners.end());
      if (*least < 0 && *most > 0) made.push_back(voxel);
    }
  }
  return made;
}

using Find = std::optional<double> (*)(const VoxelCrossing&);

template <class Real>
std::optional<double> widened(const std::optional<Real>& found) {
  return found ? std::optional<double>(*found) : std::nullopt;
}

std::optional<double> midpoint(const VoxelCrossing& voxel) {
  const auto [least, most] = std::minmax_element(voxel.corners.begin(), voxel.corners.end());
  return *least < 0 && *most > 0 ? std::optional(0.5) : std::nullopt;
}
std::optional<double> linear(const VoxelCrossing& voxel) {
  const float in = trilinear(voxel, 0), out = trilinear(voxel, 1);
  return widened(reference::linear_root(CubicAlongRay<float>{{in, out - in, 0, 0}}));
}
std::optional<double> neubauer(const VoxelCrossing& voxel) {
  return widened(reference::repeated_linear_root(cubic_of<float>(voxel), 3));
}
std::optional<double> schwarze(const VoxelCrossing& voxel) {
  return widened(reference::analytic_root(cubic_of<float>(voxel)));
}
std::optional<double> marmitt(const VoxelCrossing& voxel) {
  return widened(reference::isolated_root(cubic_of<float>(voxel), 3));
}
std::optional<double> plume(const VoxelCrossing& voxel) {
  const auto p = ScalarPolynomial::cubic(trilinear(voxel, 0), trilinear(voxel, 1.0f / 3),
                                         trilinear(voxel, 2.0f / 3), trilinear(voxel, 1));
  double from = 0;
  for (const double to : p.extrema()) {
    if (p(from) * p(to) <= 0) return p.place_of(0, from, to);
    from = to;
  }
  if (p(from) * p(1) <= 0) return p.place_of(0, from, 1);
  return std::nullopt;
}

struct Method {
  const char* name;
  const char* correctness;  // as the thesis says
  std::array<const char*, 3> theirs;
  Find find;
};
constexpr Method kMethods[] = {{"Midpoint", "-", {"26.21", "26.18", "26.22"}, midpoint},
                               {"Linear", "-", {"6.65", "6.65", "6.68"}, linear},
                               {"Neubauer", "-", {"2.93", "2.94", "2.94"}, neubauer},
                               {"Schwarze", "+", {"1.60", "1.56", "1.48"}, schwarze},
                               {"New", "+", {"2.76", "2.80", "2.73"}, marmitt},
                               {"Plume", "", {"", "", ""}, plume}};

struct DataSet {
  const char* name;
  StandInField field;
  std::array<int, 3> points;
  float isovalue;
};
constexpr DataSet kDataSets[] = {{"Bonsai*", bonsai_field, {256, 256, 256}, 0.2f},
                                 {"Aneurism*", aneurism_field, {256, 256, 256}, 0.4f},
                                 {"Engine*", engine_field, {256, 256, 128}, 0.3f}};

}  // namespace

std::string thesis_table_4_5(const PaperOptions& options) {
  std::vector<std::vector<std::string>> rows{{"data set", "method", "thesis: correct", "M voxels/s",
                                              "here: M voxels/s", "wrong, %", "missed, %",
                                              "invented, %", "far, %", "worst of the others"}};
  for (std::size_t d = 0; d < std::size(kDataSets); ++d) {
    const DataSet& data = kDataSets[d];
    auto points = data.points;
    if (options.quick)
      for (int& count : points) count /= 8;
    const auto crossings =
        crossings_of(stand_in_grid(data.field, points), data.isovalue, options.quick ? 500 : 20000);
    std::vector<reference::KnownCubic> known;
    for (const VoxelCrossing& voxel : crossings) {
      const CubicAlongRay<double> cubic = cubic_of<double>(voxel);
      known.push_back({cubic, reference::first_root(cubic)});
    }
    double sum = 0;
    std::vector<std::function<void()>> tasks;
    for (const Method& method : kMethods)
      tasks.emplace_back([&crossings, &sum, find = method.find] {
        for (const VoxelCrossing& voxel : crossings) sum += find(voxel).value_or(2);
      });
    const auto seconds = take_turns(tasks, options.rounds);
    if (!std::isfinite(sum)) throw Error("a place along a ray is not a number");
    for (std::size_t m = 0; m < std::size(kMethods); ++m) {
      const Method& method = kMethods[m];
      std::size_t at = 0;
      const auto score = reference::score_of<double>(
          known, [&](const auto&) { return method.find(crossings[at++]); });
      const auto share = [&](int of) {
        return fmt::format("{:.2f}", 100.0 * of / static_cast<double>(crossings.size()));
      };
      rows.push_back(
          {m == 0 ? data.name : "", method.name, method.correctness, method.theirs[d],
           fmt::format("{:.1f}", 1e-6 * static_cast<double>(crossings.size()) / median(seconds[m])),
           share(score.wrong()), share(score.missed), share(score.invented), share(score.far),
           fmt::format("{:.0e}", score.worst)});
    }
  }
  return R"(Page 76, one ray at a time. Thesis: 1.8 GHz Opteron. Here: one thread.

Its methods are written anew (`tests/reference/root_finding.h`), in single precision; repeated interpolation takes three
steps. What is timed begins with the eight corners of a voxel that has some on both sides of the isovalue, and the places
where the ray comes in and goes out: two interpolations for *linear*, the cubic's coefficients for the next three.
Plume takes four values along the ray, as its walkers give them, isolates roots by extrema and finds them to 1e-12.

Of 20,000 voxels in each data set, which rays in random directions cross; right is the first root to the last bit of
a double. Missed: there is one, none was found. Invented: there is none. Far: off by more than 0.01 of the segment.
Data sets: stand-ins of the same sizes, two of 256^3 points and one of 256 x 256 x 128.

)" + markdown_table(rows);
}

}  // namespace plume::bench
