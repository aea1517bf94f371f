// The thesis' five ways to intersect a cell with an isosurface (section 4.3.3), and ours, on random
// cubics: which miss a root, which return another than the first, and how far off they are. The
// table with their times: plume_bench --benchmark_filter=roots.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "plume/preint/scalar_polynomial.h"
#include "plume/tests/reference/root_scores.h"

namespace plume {
namespace {

using reference::CubicAlongRay;
using reference::RootScore;
using reference::score_of;

constexpr int kCubics = 4000;

// As cells have them, and ones that bend several times as much as they rise.
const std::vector<reference::KnownCubic>& mild() {
  static const auto made = reference::random_cubics(kCubics, 0.25);
  return made;
}
const std::vector<reference::KnownCubic>& bent() {
  static const auto made = reference::random_cubics(kCubics, 2);
  return made;
}

// Ours: the pieces between the extrema, and in the first that has the value, where.
std::optional<double> ours(const CubicAlongRay<double>& f) {
  auto at = [&](double u) { return static_cast<float>(f(u)); };
  const auto p = ScalarPolynomial::cubic(at(0), at(1.0 / 3), at(2.0 / 3), at(1));
  std::vector<double> ends{0};
  ends.insert(ends.end(), p.extrema().begin(), p.extrema().end());
  ends.push_back(1);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    if (p(ends[i]) * p(ends[i + 1]) <= 0) return p.place_of(0, ends[i], ends[i + 1]);
  return std::nullopt;
}

const auto midpoint = [](const auto& f) { return reference::midpoint_root(f); };
const auto linear = [](const auto& f) { return reference::linear_root(f); };
const auto repeated = [](const auto& f) { return reference::repeated_linear_root(f, 3); };
const auto analytic = [](const auto& f) { return reference::analytic_root(f); };
const auto isolated = [](const auto& f) { return reference::isolated_root(f, 3); };

TEST(RootFinding, approximate_methods_miss_two_roots_in_one_cell) {
  for (const RootScore& s : {score_of<float>(bent(), midpoint), score_of<float>(bent(), linear),
                             score_of<float>(bent(), repeated)}) {
    EXPECT_GT(s.missed, kCubics / 10);
    EXPECT_GT(s.far, 0);
  }
}

TEST(RootFinding, interpolation_is_nearer_than_the_middle_and_repeated_nearer_still) {
  const RootScore middle = score_of<float>(mild(), midpoint);
  const RootScore once = score_of<float>(mild(), linear);
  const RootScore thrice = score_of<float>(mild(), repeated);
  EXPECT_LT(once.far, middle.far);
  EXPECT_LT(thrice.far, once.far / 2);
  EXPECT_EQ(thrice.missed, once.missed);
}

TEST(RootFinding, isolated_roots_are_the_first) {
  for (const auto* cubics : {&mild(), &bent()}) {
    const RootScore three = score_of<float>(*cubics, isolated);
    // Where a cubic only just touches the value, single precision may say that it does not.
    EXPECT_LE(three.missed + three.invented, kCubics / 1000);
    const RootScore many =
        score_of<double>(*cubics, [](const auto& f) { return reference::isolated_root(f, 1000); });
    EXPECT_EQ(many.missed + many.invented, 0);
    // A fixed number of steps need not have arrived.
    EXPECT_LT(many.far, three.far);
  }
}

TEST(RootFinding, closed_form_needs_double_precision) {
  const RootScore exact = score_of<double>(bent(), analytic);
  const RootScore single = score_of<float>(bent(), analytic);
  EXPECT_EQ(exact.wrong(), 0);
  EXPECT_GT(single.wrong(), 0);
  EXPECT_GT(single.worst, 1000 * exact.worst);
}

TEST(RootFinding, ours_is_within_rounding_of_the_sampled_values) {
  for (const auto* cubics : {&mild(), &bent()}) {
    const RootScore s = score_of<double>(*cubics, ours);
    EXPECT_LE(s.wrong(), kCubics / 1000);
    EXPECT_LT(s.worst, 1e-4);
  }
}

}  // namespace
}  // namespace plume
