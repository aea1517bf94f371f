// The scalar inside of cells: what it converges to, that neighbours agree, and what bad cells do.

#include "plume/traverse/inner_scalar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "cell_forms.h"
#include "mesh_spots.h"
#include "plume/mesh/cell_shape.h"
#include "plume/tests/mesh/test_meshes.h"
#include "plume/tests/reference/isoparametric.h"

namespace plume::test {
namespace {

struct Error {
  double rms = 0, max = 0;
  std::size_t samples = 0, kept_linear = 0;
};

// How far segments' scalars are from the isoparametric oracle, along seeded rays.
template <class Walker>
Error error_along_rays(const Form<Walker>& form, const ScalarRequest& request, int rays) {
  const Bounds bounds = bounds_of(form.user.points);
  MeshSpots spots(form.user, bounds, 31);
  const CellReader cells(form.user);
  Error error;
  double sum = 0;
  std::vector<std::uint32_t> ids;
  std::vector<std::array<double, 3>> points;
  std::vector<double> scalars;
  for (int i = 0; i < rays; ++i) {
    const Ray ray = ray_towards(spots.around(), spots.inside());
    for (const Segment& s : form.segments(ray, request)) {
      if (s.t_out - s.t_in < 1e-3 * bounds.diagonal() / std::cbrt(form.user.cell_count())) continue;
      if (s.order != request.order) ++error.kept_linear;
      const std::uint32_t cell = form.mesh.original_cell(s.cell);
      cells.points(cell, ids);
      points.clear();
      scalars.clear();
      for (const std::uint32_t id : ids) {
        points.push_back(point_at(form.user, id));
        scalars.push_back(form.field.values[id]);
      }
      for (const double share : {0.1, 0.3, 0.5, 0.75, 0.9}) {
        const double t = s.t_in + share * (s.t_out - s.t_in);
        std::array<double, 3> place;
        for (std::size_t a = 0; a < 3; ++a) place[a] = ray.origin[a] + t * ray.direction[a];
        const auto truth = reference::isoparametric_scalar(static_cast<int>(cells.type(cell)),
                                                           points, scalars, place);
        EXPECT_TRUE(truth) << "cell " << cell;
        if (!truth) continue;
        const double off = std::abs(scalar_at(s, share) - *truth);
        error.max = std::max(error.max, off);
        sum += off * off;
        ++error.samples;
      }
    }
  }
  error.rms = std::sqrt(sum / static_cast<double>(error.samples));
  return error;
}

constexpr ScalarOrder kOrders[] = {ScalarOrder::linear, ScalarOrder::quadratic, ScalarOrder::cubic};

// Refines four times. The orders of convergence of the RMS error from the second mesh on, as far as
// the error is above what single precision makes of values of size one.
struct Convergence {
  std::array<double, 3> order{}, finest{};
};

template <class Walker, class Map>
Convergence converge(const char* name, const Map& map) {
  constexpr double kRounding = 2e-7;
  Convergence result;
  std::array<double, 3> second{};
  std::printf("%s: RMS (max) error against the isoparametric oracle, orders 1, 2, 3\n", name);
  for (int level = 0; level < 5; ++level) {
    const int size = 3 << level;
    const Form<Walker> form(mapped(generate(name, {size, 0, 1}), map, smooth_field));
    std::printf("%4d cells an edge:", size);
    for (std::size_t k = 0; k < 3; ++k) {
      const Error error = error_along_rays(form, kOrders[k], 120);
      EXPECT_EQ(error.kept_linear, 0u);
      if (level == 1) second[k] = error.rms;
      if (level > 1 && error.rms > kRounding)
        result.order[k] = std::log2(second[k] / error.rms) / (level - 1);
      std::printf("  %.2e (%.1e)", error.rms, error.max);
      result.finest[k] = error.rms;
    }
    std::printf("\n");
  }
  std::printf("     orders of convergence: %.2f %.2f %.2f\n", result.order[0], result.order[1],
              result.order[2]);
  return result;
}

TEST(InnerScalar, ConvergesByItsOrderOnATwistedGrid) {
  for (const Convergence& c :
       {converge<GridWalker>("box-hexahedra", twist), converge<CellWalker>("box-wedges", twist)}) {
    EXPECT_NEAR(c.order[0], 2, 0.15);
    EXPECT_NEAR(c.order[1], 3, 0.15);
    EXPECT_NEAR(c.order[2], 4, 0.25);
  }
}

// Where cells are twisted by the same share of their size however fine they are, the field's own
// second derivatives bend with the cells: no order falls faster than the square of their size, and
// what higher orders gain is a factor.
TEST(InnerScalar, GainsAFactorWhereRefinementDoesNotUntwist) {
  auto same = [](const std::array<double, 3>& p) { return p; };
  const Convergence c = converge<GridWalker>("twisted", same);
  for (const double order : c.order) EXPECT_NEAR(order, 2, 0.2);
  EXPECT_LT(4 * c.finest[1], c.finest[0]);
  EXPECT_LT(3 * c.finest[2], c.finest[1]);
}

// Coarse and twisted cells, where no fixed order will do.
template <class Walker>
void expect_adaptive(const char* name, double jitter) {
  SCOPED_TRACE(name);
  const Form<Walker> form(mapped(generate(name, {3, jitter, 5}), twist, smooth_field));
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    const Error error = error_along_rays(form, {ScalarOrder::adaptive, tolerance}, 60);
    // Between the places where it was looked at a cubic may be off by more, by some factor.
    EXPECT_LE(error.max, 2 * tolerance + 2e-7) << tolerance;
  }
  // Parts of a cell join, and begin and end where the cell's linear segment does.
  MeshSpots spots(form.user, bounds_of(form.user.points), 31);
  std::size_t cut = 0;
  for (int i = 0; i < 60; ++i) {
    const Ray ray = ray_towards(spots.around(), spots.inside());
    const auto whole = form.segments(ray, ScalarOrder::linear);
    const auto parts = form.segments(ray, {ScalarOrder::adaptive, 1e-6});
    std::size_t at = 0;
    for (const Segment& segment : whole) {
      ASSERT_LT(at, parts.size());
      EXPECT_EQ(parts[at].t_in, segment.t_in);
      EXPECT_EQ(parts[at].s_in, segment.s_in);
      while (parts[at].t_out != segment.t_out) {
        ASSERT_LT(++at, parts.size());
        EXPECT_EQ(parts[at].t_in, parts[at - 1].t_out);
        EXPECT_EQ(parts[at].s_in, parts[at - 1].s_out);
        EXPECT_EQ(parts[at].cell, segment.cell);
        ++cut;
      }
      EXPECT_EQ(parts[at].s_out, segment.s_out);
      ++at;
    }
    EXPECT_EQ(at, parts.size());
  }
  EXPECT_GT(cut, 100u);
}

TEST(InnerScalar, AdaptiveFollowsTheInterpolationToItsTolerance) {
  expect_adaptive<GridWalker>("twisted", 0.3);
  expect_adaptive<CellWalker>("box-wedges", 0.1);
}

// A random place in one of the parts of a face by which it is measured, and its scalar.
struct FacePlace {
  Place place;
  double scalar;
};

class FacePlaces {
 public:
  explicit FacePlaces(std::uint64_t seed) : random_(seed) {}

  FacePlace operator()(const std::vector<PointValue>& loop) {
    const double u = uniform_(random_), v = uniform_(random_);
    PointValue p{};
    auto add = [&p](double weight, const PointValue& q) { add_multiple(p, weight, q); };
    if (loop.size() == 4) {
      add((1 - u) * (1 - v), loop[0]);
      add(u * (1 - v), loop[1]);
      add(u * v, loop[2]);
      add((1 - u) * v, loop[3]);
    } else {
      PointValue middle{};
      for (const PointValue& q : loop) add_multiple(middle, 1.0 / loop.size(), q);
      const std::size_t i = random_() % loop.size();
      const double a = u < v ? u : v, b = std::abs(u - v);
      add(a, loop.size() == 3 ? loop[(i + 2) % 3] : middle);
      add(b, loop[i]);
      add(1 - a - b, loop[(i + 1) % loop.size()]);
    }
    return {{p[0], p[1], p[2]}, p[3]};
  }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> uniform_{0, 1};
};

TEST(InnerScalar, IsTheSameFromBothSidesOfAFace) {
  for (const char* name : {"box-wedges", "box-mixed", "box-polyhedra"}) {
    SCOPED_TRACE(name);
    const Form<CellWalker> form(mapped(generate(name, {5, 0.2, 3}), twist, smooth_field));
    const double range = form.field.high - form.field.low;
    FacePlaces places(7);
    std::size_t checked = 0;
    for (std::uint32_t face = 0; face < form.mesh.face_sides.size(); ++face) {
      std::vector<PointValue> loop;
      for (const std::uint32_t id : form.mesh.loop(face))
        loop.push_back(point_value(form.mesh.points[id]));
      for (int i = 0; i < 8; ++i) {
        const FacePlace p = places(loop);
        for (const std::uint32_t cell :
             {form.mesh.face_sides[face].owner, form.mesh.face_sides[face].neighbor}) {
          if (cell == kNone || shape_of(form.mesh, cell).type == CellType::tetrahedron) continue;
          float scalar = 0;
          ASSERT_TRUE(scalars_inside(form.mesh, cell, {&p.place, 1}, &scalar)) << "cell " << cell;
          ASSERT_NEAR(scalar, p.scalar, 1e-6 * range) << "face " << face << " cell " << cell;
          ++checked;
        }
      }
    }
    EXPECT_GT(checked, 1000u);
  }
}

TEST(InnerScalar, IsTheSameFromBothSidesOfAGridsFaces) {
  const Form<GridWalker> form(mapped(generate("box-hexahedra", {6, 0.2, 3}), twist, smooth_field));
  const double range = form.field.high - form.field.low;
  constexpr std::uint32_t kLoops[3][4] = {{1, 3, 7, 5}, {2, 6, 7, 3}, {4, 5, 7, 6}};  // +i, +j, +k
  FacePlaces places(8);
  const std::uint32_t ni = form.mesh.dimensions[0], nij = ni * form.mesh.dimensions[1];
  for (std::uint32_t cell = 0; cell < form.mesh.cell_count(); ++cell)
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t neighbor = form.mesh.neighbor(cell, 2 * axis + 1);
      if (neighbor == kNone) continue;
      std::vector<PointValue> loop;
      for (const std::uint32_t c : kLoops[axis])
        loop.push_back(point_value(form.mesh.points[form.mesh.first_point(cell) + (c & 1) +
                                                    (c >> 1 & 1) * ni + (c >> 2) * nij]));
      const FacePlace p = places(loop);
      for (const std::uint32_t side : {cell, neighbor}) {
        float scalar = 0;
        ASSERT_TRUE(scalars_inside(form.mesh, side, {&p.place, 1}, &scalar));
        ASSERT_NEAR(scalar, p.scalar, 1e-6 * range);
      }
    }
}

template <class Walker>
void expect_linear_field(const char* name) {
  SCOPED_TRACE(name);
  auto map = [](const std::array<double, 3>& p) { return p; };
  const Form<Walker> form(mapped(generate(name, {6, 0.25, 4}), map, linear_field));
  const double range = form.field.high - form.field.low;
  MeshSpots spots(form.user, bounds_of(form.user.points), 5);
  std::size_t curved = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = ray_towards(spots.around(), spots.inside());
    for (const ScalarOrder order : {ScalarOrder::quadratic, ScalarOrder::cubic})
      for (const Segment& s : form.segments(ray, order)) {
        curved += s.order == order ? 1 : 0;
        for (const double share : {0.0, 1.0 / 3, 0.5, 2.0 / 3, 1.0}) {
          std::array<double, 3> place;
          const double t = s.t_in + share * (s.t_out - s.t_in);
          for (std::size_t a = 0; a < 3; ++a) place[a] = ray.origin[a] + t * ray.direction[a];
          ASSERT_NEAR(scalar_at(s, share), linear_field(place), 1e-6 * range) << "ray " << i;
        }
      }
  }
  EXPECT_GT(curved, 10000u);
}

TEST(InnerScalar, ReproducesALinearFieldInEveryCell) {
  expect_linear_field<GridWalker>("box-hexahedra");
  expect_linear_field<GridWalker>("twisted");
  expect_linear_field<CellWalker>("box-wedges");
  expect_linear_field<CellWalker>("box-mixed");
  expect_linear_field<CellWalker>("box-polyhedra");
  expect_linear_field<CellWalker>("two-blocks");
}

TEST(InnerScalar, OfAParallelepipedIsTheExactCubic) {
  auto sheared = [](const std::array<double, 3>& p) {
    return std::array<double, 3>{p[0] + 0.5 * p[1], p[1] - 0.25 * p[2], 0.5 * p[2] + 0.25 * p[0]};
  };
  // Points, and values at them, of few bits.
  auto bits = [](const std::array<double, 3>& p) {
    return std::floor(16 * std::sin(40 * p[0] + 17 * p[1]) * std::cos(33 * p[2]));
  };
  const Form<GridWalker> form(mapped(generate("box-hexahedra", {8, 0, 1}), sheared, bits));
  const Error cubic = error_along_rays(form, ScalarOrder::cubic, 100);
  const Error quadratic = error_along_rays(form, ScalarOrder::quadratic, 100);
  EXPECT_EQ(cubic.kept_linear, 0u);
  EXPECT_LT(cubic.max, 1e-3);  // values of size 16 across cells of which rounding is 2e-6
  EXPECT_GT(quadratic.max, 0.1);
}

TEST(InnerScalar, ACutSegmentIsPartOfTheSamePolynomial) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<float> value(-2, 2);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 3000; ++i) {
    Segment whole{
        2, 5, value(random), value(random), 0, kOrders[i % 3], {value(random), value(random)}};
    const double a = 2 + 3 * uniform(random), b = 2 + 3 * uniform(random);
    Segment part = whole;
    cut(part, std::min(a, b), i % 5 == 0 ? 6 : std::max(a, b));
    for (const double share : {0.0, 0.2, 0.5, 0.8, 1.0}) {
      const double t = part.t_in + share * (part.t_out - part.t_in);
      ASSERT_NEAR(scalar_at(part, share), scalar_at(whole, (t - 2) / 3), 2e-5);
    }
  }
}

TEST(InnerScalar, IsNoNumberWhereAValueOfTheCellIsNone) {
  Mesh mesh = generate("box-hexahedra", {3, 0.2, 1});
  std::vector<float> values(mesh.point_count(), 1.0f);
  values[21] = std::numeric_limits<float>::quiet_NaN();  // of cell (0, 0, 0), among others
  mesh.fields = {{"value", Association::point, 1, Array::own(values)}};
  mesh.active_field = "value";
  const Form<GridWalker> form(mesh);
  const Place place{-0.6, -0.6, -0.6};
  float scalar = 0;
  ASSERT_TRUE(scalars_inside(form.mesh, 0, {&place, 1}, &scalar));
  EXPECT_TRUE(std::isnan(scalar));
}

// Cells that no field belongs in: tangled, flat, collapsed, thin. Any answer is a number that
// trilinear interpolation of values in [-1, 1] can give within kFarthestOutside of the cell.
TEST(InnerScalar, GivesNumbersInsideOfTheWorstCells) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<float> uniform(-1, 1);
  const double most = std::pow(1 + 2 * kFarthestOutside, 3);
  std::array<std::size_t, 5> answered{}, tried{};
  for (int i = 0; i < 100000; ++i) {
    std::array<WalkablePoint, 8> c;
    const std::size_t kind = static_cast<std::size_t>(i) % 5;
    for (std::size_t k = 0; k < 8; ++k) {
      const float thickness = kind == 1 ? 0 : kind == 2 ? 1e-6f : 1;
      const float jitter = kind == 0 ? 2.0f : 0.1f;
      c[k] = {{static_cast<float>(k & 1) - 0.5f + jitter * uniform(random),
               static_cast<float>(k >> 1 & 1) - 0.5f + jitter * uniform(random),
               thickness * (static_cast<float>(k >> 2) - 0.5f + jitter * uniform(random))},
              uniform(random)};
    }
    if (kind == 3)  // one to four corners on others
      for (int repeat = 0; repeat <= i / 5 % 4; ++repeat)
        std::copy_n(c[random() % 8].position, 3, c[random() % 8].position);
    if (kind == 4)  // inside out
      for (WalkablePoint& p : c) p.position[0] = -p.position[0];
    const auto map = MultilinearMap::hexahedron(c);
    const Place parameters{0.5 + 0.4 * uniform(random), 0.5 + 0.4 * uniform(random),
                           0.5 + 0.4 * uniform(random)};
    const PointValue inside = map.at(parameters);
    const auto found = invert(map, {inside[0], inside[1], inside[2]}, map.center());
    ++tried[kind];
    if (!found) continue;
    ++answered[kind];
    const PointValue there = map.at(*found);
    ASSERT_LE(std::abs(there[3]), most);
    ASSERT_GE(map.depth(*found), -kFarthestOutside);
    for (std::size_t a = 0; a < 3; ++a)
      ASSERT_NEAR(there[a], inside[a], 1e-5) << "kind " << kind << ", cell " << i;
    if (kind == 2 || kind == 4) {
      for (std::size_t a = 0; a < 3; ++a) ASSERT_NEAR((*found)[a], parameters[a], 1e-6) << kind;
    }
  }
  for (std::size_t kind = 0; kind < 5; ++kind)
    std::printf("%s: %zu of %zu answered\n",
                std::array{"tangled", "flat", "thin", "collapsed", "inside out"}[kind],
                answered[kind], tried[kind]);
  EXPECT_EQ(answered[1], 0u);        // a cell without volume has no inside
  EXPECT_EQ(answered[2], tried[2]);  // one of 1e-6 of its width has, as has one inside out
  EXPECT_EQ(answered[4], tried[4]);
}

// Rays through grids with poles, folded and touching cells: segments' scalars are numbers, their
// ends those of order 1, and few stay linear.
template <class Walker>
void expect_sound_segments(const char* name, double jitter, double most_linear) {
  SCOPED_TRACE(name);
  const Form<Walker> form(generate(name, {8, jitter, 2}));
  MeshSpots spots(form.user, bounds_of(form.user.points), 6);
  std::size_t linear = 0, all = 0;
  for (int i = 0; i < 3000; ++i) {
    const Ray ray = ray_towards(spots.around(), i % 3 == 0 ? spots.vertex() : spots.inside());
    const auto plain = form.segments(ray, ScalarOrder::linear);
    const auto cubic = form.segments(ray, ScalarOrder::cubic);
    ASSERT_EQ(plain.size(), cubic.size());
    for (std::size_t s = 0; s < plain.size(); ++s) {
      ASSERT_EQ(plain[s].t_in, cubic[s].t_in);
      ASSERT_EQ(plain[s].t_out, cubic[s].t_out);
      ASSERT_EQ(plain[s].s_in, cubic[s].s_in);
      ASSERT_EQ(plain[s].s_out, cubic[s].s_out);
      ASSERT_TRUE(std::isfinite(cubic[s].inner[0]) && std::isfinite(cubic[s].inner[1]));
      ASSERT_LT(std::abs(cubic[s].inner[0]), 3.4 * form.field.high);
      if (plain[s].t_in == plain[s].t_out) continue;
      ++all;
      linear += cubic[s].order == ScalarOrder::linear ? 1 : 0;
    }
  }
  std::printf("%s, jitter %g: %zu of %zu segments stay linear\n", name, jitter, linear, all);
  EXPECT_LE(static_cast<double>(linear), most_linear * static_cast<double>(all));
}

TEST(InnerScalar, IsSoundInBadMeshes) {
  expect_sound_segments<GridWalker>("box-hexahedra", 0.2, 0);
  expect_sound_segments<GridWalker>("twisted", 0, 0);
  expect_sound_segments<GridWalker>("box-hexahedra", 3.0, 0.6);
  expect_sound_segments<GridWalker>("o-grid", 0, 0.01);
  expect_sound_segments<GridWalker>("sphere", 0, 0.01);
  expect_sound_segments<CellWalker>("box-wedges", 0.2, 0);
  expect_sound_segments<CellWalker>("box-polyhedra", 0.2, 0);
}

// A prism over a U: its centre lies between the legs, outside of it, and sees few of its faces.
TEST(InnerScalar, OfAConcavePolyhedronIsTheLinearFieldToo) {
  const std::vector<std::array<double, 2>> outline{{0, 0}, {3, 0}, {3, 3}, {2, 3},
                                                   {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  std::vector<double> points;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : outline) points.insert(points.end(), {x, y, z + 0.1 * x});
  std::vector<std::int32_t> faces{10, 8};
  for (std::int32_t i = 7; i >= 0; --i) faces.push_back(i);
  faces.push_back(8);
  for (std::int32_t i = 0; i < 8; ++i) faces.push_back(8 + i);
  for (std::int32_t i = 0; i < 8; ++i)
    faces.insert(faces.end(), {4, i, (i + 1) % 8, 8 + (i + 1) % 8, 8 + i});
  const Mesh mesh = one_polyhedron(points, faces);
  auto same = [](const std::array<double, 3>& p) { return p; };
  const Form<CellWalker> form(mapped(mesh, same, linear_field));
  ASSERT_EQ(form.mesh.cell_count(), 1u);
  const double range = form.field.high - form.field.low;
  MeshSpots spots(form.user, bounds_of(form.user.points), 8);
  std::size_t cubic = 0, all = 0;
  for (int i = 0; i < 3000; ++i) {
    const Ray ray = ray_towards(spots.around(), spots.inside());
    for (const Segment& s : form.segments(ray, ScalarOrder::cubic)) {
      ++all;
      cubic += s.order == ScalarOrder::cubic ? 1 : 0;
      for (const double share : {0.2, 0.5, 0.9}) {
        std::array<double, 3> place;
        const double t = s.t_in + share * (s.t_out - s.t_in);
        for (std::size_t a = 0; a < 3; ++a) place[a] = ray.origin[a] + t * ray.direction[a];
        ASSERT_NEAR(scalar_at(s, share), linear_field(place), 1e-6 * range) << "ray " << i;
      }
    }
  }
  EXPECT_GT(all, 1000u);
  EXPECT_GT(2 * cubic, all);
}

TEST(CellShape, IsWhatIsThereAndNotWhatItIsCalled) {
  auto shape = [](const Mesh& mesh) {
    const auto walkable =
        make_walkable_cells(mesh, select_field(mesh), check_structure(mesh), true);
    EXPECT_EQ(walkable.cell_count(), 1u);
    return shape_of(walkable, 0).type;
  };
  auto hexahedron = [&](std::vector<std::int32_t> ids) {
    return shape(make_mesh(CellType::hexahedron, cube_points(), std::move(ids)));
  };
  EXPECT_EQ(hexahedron({0, 1, 2, 3, 4, 5, 6, 7}), CellType::hexahedron);
  EXPECT_EQ(hexahedron({0, 1, 2, 2, 4, 5, 6, 6}), CellType::wedge);
  EXPECT_EQ(hexahedron({0, 1, 2, 3, 4, 4, 4, 4}), CellType::pyramid);
  EXPECT_EQ(hexahedron({0, 1, 2, 2, 4, 4, 4, 4}), CellType::tetrahedron);
  EXPECT_EQ(hexahedron({0, 1, 2, 2, 4, 5, 6, 7}), CellType::polyhedron);  // one edge collapsed
  EXPECT_EQ(shape(make_mesh(CellType::voxel, cube_points(), {0, 1, 3, 2, 4, 5, 7, 6})),
            CellType::hexahedron);
  EXPECT_EQ(shape(one_polyhedron(cube_points(), {6, 4, 0, 3, 2, 1, 4, 4, 5, 6, 7, 4, 0, 1, 5, 4,
                                                 4, 1, 2, 6, 5, 4, 2, 3, 7, 6, 4, 3, 0, 4, 7})),
            CellType::hexahedron);
}

TEST(CellShape, IsToldFromTheFaces) {
  // Every type that a file may call by its name has the shape of that name.
  for (const char* name : {"box-mixed", "box-wedges", "two-blocks", "box-polyhedra"}) {
    const Mesh mesh = generate(name, {4, 0.2, 1});
    const CellReader cells(mesh);
    const auto walkable =
        make_walkable_cells(mesh, select_field(mesh), check_structure(mesh), true);
    for (std::uint32_t c = 0; c < walkable.cell_count(); ++c) {
      const CellShape shape = shape_of(walkable, c);
      const CellType type = cells.type(walkable.original_cell(c));
      if (type != CellType::polyhedron) {
        ASSERT_EQ(shape.type, type) << name;
      } else {
        // Prisms over quadrilaterals are hexahedra, all others stay polyhedra.
        const bool six = walkable.faces_of(c).size() == 6;
        ASSERT_EQ(shape.type, six ? CellType::hexahedron : CellType::polyhedron) << name;
      }
    }
  }
}

}  // namespace
}  // namespace plume::test
