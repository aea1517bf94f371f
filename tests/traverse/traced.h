/// A mesh made ready to trace, and what every ray through it must fulfil.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "plume/mesh/validate.h"
#include "plume/tests/reference/box_chord.h"
#include "plume/tests/traverse/adversarial_rays.h"
#include "plume/traverse/trace.h"

namespace plume::test {

struct Walk {
  TraceResult result;
  std::vector<Segment> segments;

  double sum() const {
    double total = 0;
    for (const Segment& s : segments) total += s.t_out - s.t_in;
    return total;
  }
};

template <class Walker>
struct Traced {
  typename Walker::Mesh mesh;
  BoundaryIndex<Walker> boundary;

  explicit Traced(typename Walker::Mesh m) : mesh(std::move(m)), boundary(mesh) {}

  Walk operator()(const Ray& ray) const {
    Walk walk;
    walk.result = trace(mesh, boundary, ray, [&](const Segment& segment) {
      walk.segments.push_back(segment);
      return true;
    });
    return walk;
  }
};

inline Traced<TetWalker> trace_as_tets(const Mesh& mesh) {
  return Traced<TetWalker>(
      make_walkable_tets(mesh, select_field(mesh), check_structure(mesh), true));
}
template <class Walker = GridWalker>
Traced<Walker> trace_as_grid(const Mesh& mesh) {
  return Traced<Walker>(make_walkable_grid(mesh, select_field(mesh), check_structure(mesh)));
}
inline Traced<CellWalker> trace_as_cells(const Mesh& mesh) {
  return Traced<CellWalker>(
      make_walkable_cells(mesh, select_field(mesh), check_structure(mesh), true));
}

// The box made smaller and larger by what single precision resolves of the mesh.
inline void expect_chord(const Bounds& bounds, const Ray& ray, double sum,
                         const std::string& which) {
  const auto range = reference::box_chord_range(bounds.low, bounds.high, ray.origin, ray.direction,
                                                2e-6 * bounds.diagonal());
  ASSERT_GE(sum, range[0]) << which;
  ASSERT_LE(sum, range[1]) << which;
}

// `rays` rays through a mesh that fills its bounds: none lost, segments that join, sums that are
// chords, and the same backwards. A face that is left through on the way forth is left through from
// its other side on the way back: both cells measure the same scalar on it. Bit for bit, but for
// tetrahedra, each of which has an order of its own for a face's points: there to a millionth.
template <class Walker>
void expect_no_ray_lost(const Traced<Walker>& traced, const Mesh& mesh, std::uint64_t rays,
                        std::uint64_t seed, bool folded) {
  const Bounds bounds = bounds_of(mesh.points);
  AdversarialRays make_ray(mesh, bounds, seed);
  for (std::uint64_t i = 0; i < rays; ++i) {
    Ray ray = make_ray(i);
    ray.t_min = -std::numeric_limits<double>::infinity();
    const std::string which = "ray " + std::to_string(i);
    const Walk walk = traced(ray);
    ASSERT_EQ(walk.result.end, WalkEnd::left) << which;
    ASSERT_EQ(walk.result.cells, walk.segments.size()) << which;
    expect_chord(bounds, ray, walk.sum(), which);
    for (std::size_t s = 0; s < walk.segments.size(); ++s) {
      ASSERT_LE(walk.segments[s].t_in, walk.segments[s].t_out) << which;
      if (s > 0 && walk.result.entries == 1) {
        ASSERT_EQ(walk.segments[s].t_in, walk.segments[s - 1].t_out) << which;
        ASSERT_EQ(walk.segments[s].s_in, walk.segments[s - 1].s_out) << which;
      }
    }
    Ray back = ray;
    for (double& x : back.direction) x = -x;
    const Walk reversed = traced(back);
    ASSERT_EQ(reversed.result.entries, walk.result.entries) << which;
    if (walk.result.entries != 1) {
      expect_chord(bounds, back, reversed.sum(), which);
      continue;
    }
    ASSERT_EQ(reversed.segments.size(), walk.segments.size()) << which;
    for (std::size_t s = 0; s < walk.segments.size(); ++s) {
      const Segment& forth = walk.segments[s];
      const Segment& other = reversed.segments[walk.segments.size() - 1 - s];
      ASSERT_EQ(forth.cell, other.cell) << which;
      if constexpr (std::is_same_v<Walker, TetWalker>) {
        ASSERT_NEAR(forth.s_in, other.s_out, 1e-6) << which;
        ASSERT_NEAR(forth.s_out, other.s_in, 1e-6) << which;
      } else {
        ASSERT_EQ(forth.s_in, other.s_out) << which;
        ASSERT_EQ(forth.s_out, other.s_in) << which;
      }
      if (folded) continue;  // where cells overlap, lengths go to the first that claims them
      ASSERT_NEAR(forth.t_in, -other.t_out, 1e-6 * bounds.diagonal()) << which;
      ASSERT_NEAR(forth.t_out, -other.t_in, 1e-6 * bounds.diagonal()) << which;
    }
  }
}

}  // namespace plume::test
