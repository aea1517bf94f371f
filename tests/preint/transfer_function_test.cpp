#include "plume/preint/transfer_function.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "plume/tests/preint/transfer_functions.h"

namespace plume {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// The problem of the smooth function after a change.
template <class Change>
std::string problem_after(Change change) {
  TransferFunction function = tests::smooth_function();
  change(function.knots);
  return function.problem().value_or("");
}

void expect_names(const std::string& problem, const std::string& knot, const std::string& what) {
  EXPECT_NE(problem.find(knot), std::string::npos) << problem;
  EXPECT_NE(problem.find(what), std::string::npos) << problem;
  EXPECT_EQ(problem.find('\n'), std::string::npos) << problem;
}

TEST(TransferFunction, has_no_problem_when_well_formed) {
  for (const auto& [name, function] : tests::all_functions()) {
    EXPECT_EQ(function.problem(), std::nullopt) << name;
  }
}

TEST(TransferFunction, names_each_problem_and_its_knot) {
  EXPECT_NE(TransferFunction{}.problem().value_or("").find("at least one"), std::string::npos);
  expect_names(problem_after([](auto& k) { k[3].scalar = not_a_number; }), "knot 3", "nan");
  expect_names(problem_after([](auto& k) { k[7].scalar = infinity; }), "knot 7", "inf");
  expect_names(problem_after([](auto& k) { k[4].scalar = 0.3f; }), "knot 4", "ascend");
  expect_names(problem_after([](auto& k) { k[3].scalar = k[4].scalar = k[5].scalar; }), "knot 5",
               "step");
  expect_names(problem_after([](auto& k) { k[2].optics.extinction = -1; }), "knot 2", "extinction");
  expect_names(problem_after([](auto& k) { k[2].optics.extinction = not_a_number; }), "knot 2",
               "nan");
  expect_names(problem_after([](auto& k) { k[0].optics.extinction = infinity; }), "knot 0", "inf");
  expect_names(problem_after([](auto& k) { k[6].optics.color[0] = -0.5f; }), "knot 6", "red");
  expect_names(problem_after([](auto& k) { k[6].optics.color[1] = not_a_number; }), "knot 6",
               "green");
  expect_names(problem_after([](auto& k) { k[6].optics.color[2] = infinity; }), "knot 6", "blue");
}

TEST(TransferFunction, allows_two_knots_at_a_scalar) {
  EXPECT_EQ(problem_after([](auto& k) { k[3].scalar = k[4].scalar; }), "");
}

TEST(TransferFunction, is_linear_between_knots_and_constant_beyond) {
  const TransferFunction function = tests::smooth_function();
  for (const auto& knot : function.knots) {
    EXPECT_EQ(function.at(knot.scalar).extinction, knot.optics.extinction);
    EXPECT_EQ(function.at(knot.scalar).color, knot.optics.color);
  }
  EXPECT_FLOAT_EQ(function.at(0.775f).extinction, 5.0f);
  EXPECT_FLOAT_EQ(function.at(0.775f).color[1], 0.45f);
  EXPECT_EQ(function.at(-3).color, function.knots.front().optics.color);
  EXPECT_EQ(function.at(7).extinction, 1.0f);
  EXPECT_EQ(function.at(infinity).extinction, 1.0f);
  EXPECT_EQ(function.at(-infinity).extinction, 0.0f);
}

TEST(TransferFunction, takes_the_later_knot_at_a_step) {
  const TransferFunction function = tests::step_function();
  EXPECT_EQ(function.at(0.25f).extinction, 5.0f);
  EXPECT_EQ(function.at(0.25f).color[0], 1.0f);
  EXPECT_NEAR(function.at(std::nextafter(0.25f, 0.0f)).extinction, 0.4f, 1e-6);
}

TEST(TransferFunction, is_transparent_at_nan) {
  const Optics optics = tests::single_knot_function().at(not_a_number);
  EXPECT_EQ(optics.extinction, 0);
  EXPECT_EQ(optics.color, (std::array<float, 3>{0, 0, 0}));
}

TEST(TransferFunction, survives_knots_at_the_ends_of_the_floats) {
  constexpr float largest = std::numeric_limits<float>::max();
  const TransferFunction function{{{-largest, {0, {0, 0, 0}}}, {largest, {8, {1, 1, 1}}}}};
  EXPECT_FLOAT_EQ(function.at(0).extinction, 4);
  EXPECT_FLOAT_EQ(function.at(largest / 2).extinction, 6);
}

}  // namespace
}  // namespace plume
