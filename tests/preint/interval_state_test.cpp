// The rules by which a ray sees intervals and isosurfaces, where scalars equal bounds above all.

#include "plume/preint/interval_state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "plume/tests/preint/classified_rays.h"

namespace plume {
namespace {

using tests::composite;
using tests::crossings;
using tests::parts_of;
using tests::Piece;
using tests::polyline;
using Kind = ClassifiedPart::Kind;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Classification surface_at(float value) { return {{}, {}, {{value, 0.5f, {1, 1, 1}}}}; }

// An interval [1, 2] whose extinction doubles from end to end, so that its ends can be told apart.
Classification interval_1_2() {
  return {{}, {{1, 2, {{{0, {1, {1, 0, 0}}}, {1, {2, {0, 1, 0}}}}}}}, {}};
}

double opacity(const Classification& classification, const std::vector<float>& scalars) {
  return composite(classification, polyline(scalars)).alpha();
}

// 1 - exp(-integral over [from, to] of 1 + w).
double seen(double from, double to) { return -std::expm1(-(to - from) * (1 + 0.5 * (from + to))); }

TEST(Isosurface, is_crossed_once_per_passage_through_its_value) {
  const Classification one = surface_at(1);
  EXPECT_EQ(crossings(one, {0, 2}), 1);
  EXPECT_EQ(crossings(one, {2, 0}), 1);
  EXPECT_EQ(crossings(one, {0, 2, 0, 2}), 3);
  EXPECT_EQ(crossings(one, {0, 0.5f, 0.2f}), 0);
  EXPECT_EQ(crossings(one, {2, 3}), 0);
}

TEST(Isosurface, at_the_value_of_a_vertex_is_crossed_neither_twice_nor_never) {
  const Classification one = surface_at(1);
  EXPECT_EQ(crossings(one, {0, 1, 2}), 1);
  EXPECT_EQ(crossings(one, {2, 1, 0}), 1);
  EXPECT_EQ(crossings(one, {0, 1, 1, 1, 2}), 1);  // a plateau
  EXPECT_EQ(crossings(one, {2, 1, 1, 1, 0}), 1);
  EXPECT_EQ(crossings(one, {2, 1, 1, 2}), 0);  // touched from above
  EXPECT_EQ(crossings(one, {2, 1, 2}), 0);
  EXPECT_EQ(crossings(one, {0, 1, 0}), 2);  // touched from below: in and out
  EXPECT_EQ(crossings(one, {0, 1, 1, 0}), 2);
  EXPECT_EQ(crossings(one, {1, 2}), 0);  // begins above
  EXPECT_EQ(crossings(one, {1, 0}), 1);
  EXPECT_EQ(crossings(one, {0, 1}), 1);
  EXPECT_EQ(crossings(one, {2, 1}), 0);
  EXPECT_EQ(crossings(one, {1, 1}), 0);
}

// However a ray is cut into pieces, and wherever these meet: the parity of crossings is whether its
// ends are on different sides.
TEST(Isosurface, crossings_of_any_ray_are_as_odd_as_its_ends_say) {
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> value(0, 4);
  for (int i = 0; i < 2000; ++i) {
    std::vector<float> scalars(2 + static_cast<std::size_t>(value(random)) * 3);
    for (float& s : scalars) s = static_cast<float>(value(random));
    const Classification one = surface_at(2);
    const bool differ = (scalars.front() >= 2) != (scalars.back() >= 2);
    EXPECT_EQ(crossings(one, scalars) % 2 == 1, differ);
    std::vector<float> back(scalars.rbegin(), scalars.rend());
    EXPECT_EQ(crossings(one, scalars), crossings(one, back));
  }
}

TEST(Isosurface, lies_where_the_scalar_has_its_value) {
  const auto parts =
      parts_of({TransferFunction{{{0, {1, {1, 1, 1}}}}}, {}, {{1}, {3}}}, {{0, 4, 1}, {4, 2, 1}});
  ASSERT_EQ(parts.size(), 8u);
  EXPECT_EQ(parts[1].kind, Kind::surface);
  EXPECT_EQ(parts[1].share_from, 0.25);
  EXPECT_TRUE(parts[1].rising);
  EXPECT_EQ(parts[3].share_from, 0.75);
  EXPECT_EQ(parts[6].kind, Kind::surface);
  EXPECT_EQ(parts[6].index, 1);
  EXPECT_EQ(parts[6].share_from, 0.5);
  EXPECT_FALSE(parts[6].rising);
  // The volume fills what lies between, end to end.
  double end = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(parts[i].share_from, end);
    end = parts[i].share_to;
  }
  EXPECT_EQ(end, 1);
}

TEST(Interval, crossed_is_seen_whole_from_either_side) {
  EXPECT_NEAR(opacity(interval_1_2(), {0, 3}), seen(0, 1), 1e-7);
  EXPECT_NEAR(opacity(interval_1_2(), {3, 0}), seen(0, 1), 1e-7);
  EXPECT_NEAR(opacity(interval_1_2(), {0, 1.25f, 1.5f, 3}), seen(0, 1), 1e-7);
}

TEST(Interval, left_by_the_end_it_was_entered_by_is_seen_as_deep_as_reached) {
  EXPECT_NEAR(opacity(interval_1_2(), {0, 1.5f, 0}), seen(0, 0.5), 1e-7);
  EXPECT_NEAR(opacity(interval_1_2(), {3, 1.75f, 3}), seen(0.75, 1), 1e-7);
  // Back and forth adds nothing.
  EXPECT_NEAR(opacity(interval_1_2(), {0, 1.5f, 1.25f, 1.5f, 1.1f, 0}), seen(0, 0.5), 1e-7);
  EXPECT_NEAR(opacity(interval_1_2(), {0, 1.5f, 1.25f, 1.75f, 1.1f, 0}), seen(0, 0.75), 1e-7);
  // Nor does what is crossed backwards at last.
  EXPECT_NEAR(opacity(interval_1_2(), {0, 1.5f, 1.25f, 3}), seen(0, 1), 1e-7);
}

TEST(Interval, each_visit_counts) {
  const double once = 1 - seen(0, 1);
  EXPECT_NEAR(opacity(interval_1_2(), {0, 3, 0}), 1 - once * once, 1e-7);
  EXPECT_NEAR(opacity(interval_1_2(), {0, 1.5f, 0, 1.5f, 0}),
              1 - (1 - seen(0, 0.5)) * (1 - seen(0, 0.5)), 1e-7);
}

TEST(Interval, is_closed_at_both_ends) {
  // Reached exactly and left again: one visit, seen whole, once; its ends are inside.
  EXPECT_NEAR(opacity(interval_1_2(), {0, 2, 0}), seen(0, 1), 1e-7);
  EXPECT_NEAR(opacity(interval_1_2(), {0, 2, 2, 2, 0}), seen(0, 1), 1e-7);
  EXPECT_NEAR(opacity(interval_1_2(), {3, 1, 3}), seen(0, 1), 1e-7);
  EXPECT_NEAR(opacity(interval_1_2(), {3, 1, 1, 3}), seen(0, 1), 1e-7);
  EXPECT_NEAR(opacity(interval_1_2(), {0, 1, 1, 2, 2, 3}), seen(0, 1), 1e-7);
  // Touched from outside: nothing.
  EXPECT_EQ(opacity(interval_1_2(), {0, 1, 1, 0}), 0);
  EXPECT_EQ(opacity(interval_1_2(), {3, 2, 2, 3}), 0);
}

TEST(Interval, cuts_its_range_out_of_the_volume) {
  Classification both = interval_1_2();
  both.volume = TransferFunction{{{0, {1, {1, 1, 1}}}}};
  double volume = 0;
  for (const auto& part : parts_of(both, polyline({0, 4, 2, 2, 1, 1, 0})))
    if (part.kind == Kind::volume) volume += part.share_to - part.share_from;
  // 0 to 1 and 2 to 4 of the first piece, 4 to 2, 1 to 0; not the plateaus.
  EXPECT_NEAR(volume, 0.75 + 1 + 1, 1e-12);
}

TEST(Interval, in_which_a_ray_begins_is_seen_whole) {
  EXPECT_NEAR(opacity(interval_1_2(), {1.5f, 3}), seen(0, 1), 1e-7);
  EXPECT_NEAR(opacity(interval_1_2(), {1.5f, 0}), seen(0, 1), 1e-7);
  EXPECT_NEAR(opacity(interval_1_2(), {1.9f, 1.1f, 1.8f, 0}), seen(0, 1), 1e-7);
  const auto parts = parts_of(interval_1_2(), polyline({1.5f, 3}));
  ASSERT_EQ(parts.size(), 1u + 1u);  // and the volume above, of which there is none to see
  EXPECT_TRUE(parts[0].clipped);
  EXPECT_EQ(parts[0].share_to, 0);
  // A later visit is one like any other.
  EXPECT_NEAR(opacity(interval_1_2(), {1.5f, 3, 1.5f, 3}),
              1 - (1 - seen(0, 1)) * (1 - seen(0.5, 1)), 1e-7);
}

TEST(Interval, at_whose_end_a_ray_begins_has_been_entered_there) {
  EXPECT_NEAR(opacity(interval_1_2(), {1, 1.5f, 0}), seen(0, 0.5), 1e-7);
  EXPECT_NEAR(opacity(interval_1_2(), {2, 1.5f, 3}), seen(0.5, 1), 1e-7);
  EXPECT_EQ(opacity(interval_1_2(), {1, 0}), 0);
  EXPECT_EQ(opacity(interval_1_2(), {2, 3}), 0);
  EXPECT_EQ(opacity(interval_1_2(), {1, 1}), 0);
}

TEST(Interval, in_which_a_ray_ends_is_seen_as_deep_as_reached) {
  EXPECT_NEAR(opacity(interval_1_2(), {0, 1.5f}), seen(0, 0.5), 1e-7);
  EXPECT_NEAR(opacity(interval_1_2(), {3, 1.5f}), seen(0.5, 1), 1e-7);
}

TEST(Interval, that_touches_another_hands_the_ray_over) {
  Classification two = interval_1_2();
  two.intervals.push_back({2, 4, even_profile(0.5f, {0, 0, 1})});
  const double upper = 0.5;
  EXPECT_NEAR(opacity(two, {0, 5}), 1 - (1 - seen(0, 1)) * (1 - upper), 1e-7);
  EXPECT_NEAR(opacity(two, {5, 0}), 1 - (1 - seen(0, 1)) * (1 - upper), 1e-7);
  // Down to their common end, which is the upper one's, and up again.
  EXPECT_NEAR(opacity(two, {5, 2, 5}), upper, 1e-7);
  // Up to it: into the upper one and out, then the lower one again from above.
  EXPECT_NEAR(opacity(two, {0, 2, 0}), 1 - (1 - seen(0, 1)) * (1 - seen(0, 1)), 1e-7);
  EXPECT_NEAR(opacity(two, {0, 2, 2, 5}), 1 - (1 - seen(0, 1)) * (1 - upper), 1e-7);
}

TEST(Interval, with_isosurfaces_at_its_ends_and_inside_is_crossed_in_order) {
  Classification with = interval_1_2();
  with.isosurfaces = {{1, 0.1f}, {1.5f, 0.2f}, {2, 0.3f}};
  auto kinds = [&](const std::vector<float>& scalars) {
    std::vector<int> indices;  // of surfaces; -1 for the interval
    for (const auto& part : parts_of(with, polyline(scalars)))
      if (part.kind != Kind::volume)
        indices.push_back(part.kind == Kind::surface ? part.index : -1);
    return indices;
  };
  EXPECT_EQ(kinds({0, 3}), (std::vector<int>{0, -1, 1, -1, 2}));
  EXPECT_EQ(kinds({3, 0}), (std::vector<int>{2, -1, 1, -1, 0}));
  EXPECT_EQ(kinds({0, 1.75f, 0}), (std::vector<int>{0, -1, 1, -1, 1, 0}));
}

TEST(IntervalState, begins_anew_after_a_reset_and_after_what_is_not_finite) {
  const Classification interval = interval_1_2();
  const double twice = 1 - (1 - seen(0, 0.5)) * (1 - seen(0, 1));
  // Out of the mesh and back inside the interval: that is a cut face.
  EXPECT_NEAR(composite(interval, {{0, 1.5f}, {kNaN, 1}, {1.5f, 3}}).alpha(), twice, 1e-7);
  EXPECT_NEAR(composite(interval, {{0, 1.5f}, {1, HUGE_VALF}, {1.5f, 3}}).alpha(), twice, 1e-7);
  const ScalarRanges ranges(surface_at(1));
  IntervalState state(ranges);
  int count = 0;
  auto visit = [&](const ClassifiedPart& part) {
    count += part.kind == Kind::surface ? 1 : 0;
    return true;
  };
  state.add(0, 0.5f, visit);
  state.reset();
  state.add(2, 3, visit);
  EXPECT_EQ(count, 0);  // what was in the gap nobody knows
}

TEST(IntervalState, crosses_what_lies_in_a_jump) {
  // Cells that are constant: 0, then 3, then 1.5.
  Classification both = interval_1_2();
  both.isosurfaces = {{0.5f, 0.5f}};
  EXPECT_NEAR(composite(both, {{0, 0}, {3, 3}, {1.5f, 1.5f}}).alpha(),
              1 - 0.5 * (1 - seen(0, 1)) * (1 - seen(0.5, 1)), 1e-7);
  for (const auto& part : parts_of(both, {{0, 0}, {3, 3}}))
    EXPECT_TRUE(part.kind == Kind::volume || part.share_to == 0);
}

TEST(IntervalState, stops_where_the_visitor_has_seen_enough) {
  const ScalarRanges ranges(surface_at(1));
  IntervalState state(ranges);
  int count = 0;
  EXPECT_FALSE(state.add(0, 2, [&](const ClassifiedPart&) { return ++count < 2; }));
  EXPECT_EQ(count, 2);
}

}  // namespace
}  // namespace plume
