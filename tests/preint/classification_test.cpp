#include "plume/preint/classification.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "plume/preint/closed_form.h"

namespace plume {
namespace {

const TransferFunction kProfile = even_profile(0.5f, {1, 0, 0});
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

void expect_problem(const Classification& classification, const std::vector<std::string>& words) {
  const auto problem = classification.problem();
  ASSERT_TRUE(problem.has_value());
  for (const std::string& word : words)
    EXPECT_NE(problem->find(word), std::string::npos) << *problem << " names no " << word;
  EXPECT_EQ(problem->find('\n'), std::string::npos);
}

TEST(Classification, has_no_problem_with_parts_apart_touching_and_none) {
  EXPECT_FALSE(Classification{}.problem());
  Classification all;
  all.volume = TransferFunction{{{0, {1, {1, 1, 1}}}}};
  all.intervals = {{0.5f, 0.75f, kProfile}, {0, 0.25f, kProfile}, {0.25f, 0.375f, kProfile}};
  all.isosurfaces = {{0.25f}, {0.1f}, {0.75f}, {2}};
  EXPECT_EQ(all.problem(), std::nullopt);
  EXPECT_FALSE(all.is_plain_volume());
  EXPECT_TRUE(Classification({all.volume, {}, {}}).is_plain_volume());
  EXPECT_FALSE(Classification{}.is_plain_volume());
}

TEST(Classification, names_values_and_remedy) {
  expect_problem({{}, {{0, 0.5f, kProfile}, {0.25f, 1, kProfile}}, {}},
                 {"[0, 0.5]", "[0.25, 1]", "overlap", "end the first at 0.25"});
  expect_problem({{}, {{0.25f, 0.5f, kProfile}, {0, 1, kProfile}}, {}},
                 {"[0.25, 0.5]", "nested in [0, 1]", "cut the outer one at 0.25 and 0.5"});
  expect_problem({{}, {{0, 1, kProfile}, {0, 2, kProfile}}, {}}, {"[0, 1]", "nested in [0, 2]"});
  expect_problem({{}, {{0, 2, kProfile}, {1, 2, kProfile}}, {}}, {"[1, 2]", "nested in [0, 2]"});
  expect_problem({{}, {{0.5f, 0.5f, kProfile}}, {}}, {"0.5", "no width", "isosurface"});
  expect_problem({{}, {{2, 1, kProfile}}, {}}, {"[2, 1]", "write [1, 2]"});
  expect_problem({{}, {{0, kNaN, kProfile}}, {}}, {"nan", "finite"});
  expect_problem({{}, {{0, 1, {}}}, {}}, {"[0, 1]", "knot"});
  expect_problem({{}, {{0, 1, {{{1.5f, {}}}}}}, {}}, {"w = 1.5", "0 to 1"});
  expect_problem({{}, {}, {{kNaN}}}, {"nan", "finite"});
  expect_problem({{}, {}, {{3, 1.5f}}}, {"at 3", "1.5", "0 to 1"});
  expect_problem({{}, {}, {{3, 1, {1, -2, 1}}}}, {"at 3", "-2", "not negative"});
  expect_problem({{}, {}, {{3}, {1}, {3}}}, {"two isosurfaces at 3"});
  expect_problem({TransferFunction{}, {}, {}}, {"knot"});
}

TEST(Classification, an_even_profile_has_the_opacity_it_is_asked_for) {
  for (const float opacity : {0.0f, 1e-6f, 0.3f, 0.99f, 1.0f}) {
    const ClosedForm optics(even_profile(opacity, {0.5f, 1, 0}));
    EXPECT_NEAR(optics.integrate(0, 1, 1).alpha, opacity, 1e-7);
    EXPECT_NEAR(optics.integrate(1, 0, 1).g, opacity, 1e-7);
  }
}

}  // namespace
}  // namespace plume
