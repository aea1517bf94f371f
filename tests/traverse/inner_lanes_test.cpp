// The scalar inside of cells by vectors in single precision, against the scalar code in double,
// with every instruction set.

#include "plume/tests/traverse/inner_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <string>
#include <vector>

#include "cell_forms.h"
#include "mesh_spots.h"
#include "packet_sums.h"
#include "plume/mesh/corner_cells.h"
#include "plume/tests/mesh/test_meshes.h"
#include "plume/traverse/inner_scalar.h"

namespace plume::test {
namespace {

template <class Walker>
struct Asked {
  Form<Walker> form;
  std::deque<ShearedFrame> frames;                 // stay where they are
  std::array<std::vector<InnerQuery>, 3> queries;  // by axis
  double range = 0;

  Asked(const Mesh& mesh, int rays) : form(mesh) {
    if constexpr (std::is_same_v<Walker, CellWalker>)
      form.mesh.corner_cells = make_corner_cells(form.mesh);
    MeshSpots spots(form.user, bounds_of(form.user.points), 37);
    for (int i = 0; i < rays; ++i) {
      const Ray ray = ray_towards(spots.around(), spots.inside());
      ShearedFrame& frame = frames.emplace_back();
      EXPECT_TRUE(frame.set(ray, form.mesh.frame));
      for (const Segment& segment : form.segments(ray, ScalarOrder::linear)) {
        auto z = [&](double t) { return static_cast<float>((t - frame.t(0)) / frame.t_per_z()); };
        queries[static_cast<std::size_t>(frame.axis())].push_back(
            {&frame, z(segment.t_in), z(segment.t_out), segment.cell});
      }
    }
    const auto [least, greatest] =
        std::minmax_element(form.field.values.begin(), form.field.values.end());
    range = static_cast<double>(*greatest) - *least;
  }

  // Of some places; nothing where there is no answer.
  std::optional<float> scalar(std::uint32_t cell, const Place& place) const {
    float value = 0;
    if (!scalars_inside(form.mesh, cell, {&place, 1}, &value)) return std::nullopt;
    return value;
  }
};

struct Difference {
  std::size_t compared = 0, unknown = 0;
  double worst = 0;  // in shares of the field's range
};

// What is found is what is at a place no farther off than single precision moves it, and as many
// segments have an answer.
template <class Walker>
Difference compare(const Asked<Walker>& asked, ScalarOrder order) {
  constexpr double kMoved = 0x1p-21;
  Difference difference;
  const std::size_t count = order == ScalarOrder::quadratic ? 1 : 2;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& queries = asked.queries[static_cast<std::size_t>(axis)];
    const auto answers = ask_lanes(asked.form.mesh, axis, queries, order);
    for (std::size_t q = 0; q < queries.size(); ++q) {
      const InnerQuery& query = queries[q];
      if (query.z_in == query.z_out) {
        EXPECT_FALSE(answers[q].known);
        continue;
      }
      for (std::size_t i = 0; i < count; ++i) {
        const double share = static_cast<double>(i + 1) / static_cast<double>(count + 1);
        const Place place = query.frame->local(
            query.z_in + share * (static_cast<double>(query.z_out) - query.z_in));
        const auto right = asked.scalar(query.cell, place);
        if (!right || !answers[q].known) {
          ++difference.unknown;
          continue;
        }
        double allowed = 3e-6 * asked.range;
        bool near_the_end = false;
        for (std::size_t a = 0; a < 3; ++a)
          for (const double way : {-kMoved, kMoved}) {
            Place moved = place;
            moved[a] += way;
            const auto there = asked.scalar(query.cell, moved);
            if (there)
              allowed = std::max(allowed, 3.0 * std::abs(*there - *right) + 3e-6 * asked.range);
            else
              near_the_end = true;
          }
        if (near_the_end) continue;
        ++difference.compared;
        const double off = std::abs(answers[q].inner[i] - *right);
        EXPECT_LE(off, allowed) << "cell " << query.cell << " axis " << axis;
        difference.worst = std::max(difference.worst, off / asked.range);
      }
    }
  }
  return difference;
}

template <class Walker>
void compare_all(const char* name, const Mesh& mesh, double usual) {
  SCOPED_TRACE(name);
  const Asked<Walker> asked(mesh, 150);
  const InstructionSets sets;
  for (const std::int64_t set : sets.each) {
    limit_packet_instruction_sets(set);
    SCOPED_TRACE(packet_instruction_set());
    for (const ScalarOrder order : {ScalarOrder::quadratic, ScalarOrder::cubic}) {
      const Difference found = compare(asked, order);
      std::printf("%-10s %-5s order %d: %zu places, %zu not known, off by %.1e of the range\n",
                  name, packet_instruction_set(), static_cast<int>(order), found.compared,
                  found.unknown, found.worst);
      EXPECT_GT(found.compared, 500u);
      EXPECT_LE(found.worst, usual);
      EXPECT_LE(found.unknown, found.compared / 100);
    }
  }
}

Place same(const Place& p) { return p; }
// Layers of 2e-4 of the box, the field as steep across them as anywhere.
Place layers(const Place& p) { return {p[0], p[1], 0.001 * p[2] + 0.2 * p[0] * p[1]}; }
double across_layers(const Place& p) {
  return std::sin(1000 * (p[2] - 0.2 * p[0] * p[1]) + p[0]) + p[1];
}

TEST(InnerLanes, FindWhatTheScalarCodeFinds) {
  compare_all<GridWalker>(
      "grid", mapped(generate("box-hexahedra", {6, 0.2, 5}), twist, smooth_field), 2e-6);
  compare_all<GridWalker>("twisted", mapped(generate("twisted", {6, 0, 5}), same, smooth_field),
                          2e-6);
  compare_all<CellWalker>("mixed", mapped(generate("box-mixed", {6, 0.2, 5}), twist, smooth_field),
                          2e-6);
  compare_all<CellWalker>("wedges",
                          mapped(generate("box-wedges", {6, 0.2, 5}), twist, smooth_field), 2e-6);
}

// What a float makes of a place is a good part of such a cell's thickness.
TEST(InnerLanes, FindPlacesInThinLayersAsFarAsFloatsTellThemApart) {
  compare_all<GridWalker>(
      "layers", mapped(generate("box-hexahedra", {6, 0, 5}), layers, across_layers), 3e-5);
}

}  // namespace
}  // namespace plume::test
