// Gradients: exact for linear fields in any cell, convergent for others, honest where there is
// none.

#include "plume/mesh/gradients.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "moved_mesh.h"
#include "plume/mesh/error.h"
#include "test_meshes.h"

namespace plume::test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
const char* const kForms[] = {"box-tetrahedra", "box-hexahedra", "twisted",   "box-wedges",
                              "box-mixed",      "box-polyhedra", "two-blocks"};

double linear(const Vector& p) { return 0.25 + p[0] - 2 * p[1] + 0.5 * p[2]; }
constexpr Vector kLinear{1, -2, 0.5};

Vector gradient_at(const std::vector<float>& gradients, std::size_t point) {
  return {gradients[3 * point], gradients[3 * point + 1], gradients[3 * point + 2]};
}

// A linear field before the map M is one after it, of gradient M^-T g. M^T takes what was computed
// back to where all meshes are of size one, with edges of 0.1 and more and values of at most 3.
TEST(Gradients, AreExactForLinearFieldsInEveryCell) {
  struct Case {
    const char* name;
    double scale, shear, offset;
  };
  for (const char* form : kForms)
    for (const Case& c : {Case{"plain", 1, 0, 0}, Case{"tiny", 1e-6, 0, 0}, Case{"huge", 1e6, 0, 0},
                          Case{"sheared", 1, 40, 0}, Case{"tiny and sheared", 1e-6, 40, 0},
                          Case{"far away", 1, 0, 1e6}}) {
      const Mesh plain = generate(form, {4, 0.2, 5});
      const Mesh mesh = moved_mesh(plain, [&](const Vector& p) {
        return Vector{c.offset + c.scale * (p[0] + c.shear * p[1]), c.scale * p[1],
                      c.scale * (p[2] + c.shear * p[0])};
      });
      ScalarField field = point_field(plain, linear);
      const std::vector<float> gradients = point_gradients(mesh, field);
      ASSERT_EQ(gradients.size(), 3 * mesh.point_count());
      for (std::size_t p = 0; p < mesh.point_count(); ++p) {
        const Vector g = gradient_at(gradients, p);
        const Vector back{c.scale * (g[0] + c.shear * g[2]), c.scale * (c.shear * g[0] + g[1]),
                          c.scale * g[2]};
        for (std::size_t a = 0; a < 3; ++a)
          ASSERT_NEAR(back[a], kLinear[a], 2e-5 * (1 + c.shear))
              << form << ' ' << c.name << ' ' << p;
      }
    }
}

double smooth(const Vector& p) {
  return std::sin(2 * p[0] + 1) * std::cos(1.5 * p[1]) * std::exp(p[2]);
}
Vector smooth_gradient(const Vector& p) {
  const double e = std::exp(p[2]);
  return {2 * std::cos(2 * p[0] + 1) * std::cos(1.5 * p[1]) * e,
          -1.5 * std::sin(2 * p[0] + 1) * std::sin(1.5 * p[1]) * e, smooth(p)};
}

struct Orders {
  double all, inside;
};

// Orders of convergence of the RMS error between the last two of four meshes.
Orders converge(const char* form) {
  double before[2] = {0, 0}, order[2] = {0, 0};
  std::printf("%-15s RMS error at all points, inside:", form);
  for (const int size : {4, 8, 16, 32}) {
    const Mesh plain = generate(form, {size, 0, 1});
    const Mesh mesh = moved_mesh(plain, twisted_cube);
    const auto gradients = point_gradients(mesh, point_field(mesh, smooth));
    double sum[2] = {0, 0}, count[2] = {0, 0};
    for (std::size_t p = 0; p < mesh.point_count(); ++p) {
      const Vector g = gradient_at(gradients, p), truth = smooth_gradient(point_at(mesh, p));
      const Vector at = point_at(plain, p);
      // Two blocks have a boundary between them.
      const bool inside =
          std::all_of(at.begin(), at.end(), [](double x) { return x > 0 && x < 1; }) &&
          !(form == std::string("two-blocks") && at[0] == 0.5);
      for (std::size_t k = 0; k < (inside ? 2u : 1u); ++k) {
        for (std::size_t a = 0; a < 3; ++a) sum[k] += (g[a] - truth[a]) * (g[a] - truth[a]);
        ++count[k];
      }
    }
    for (std::size_t k = 0; k < 2; ++k) {
      const double rms = std::sqrt(sum[k] / count[k]);
      order[k] = std::log2(before[k] / rms);
      before[k] = rms;
    }
    std::printf("  %.1e %.1e", before[0], before[1]);
  }
  std::printf("  orders %.2f %.2f\n", order[0], order[1]);
  return {order[0], order[1]};
}

TEST(Gradients, ConvergeOnSmoothFields) {
  const Orders grid = converge("box-hexahedra");
  EXPECT_GT(grid.all, 1.8);
  EXPECT_GT(grid.inside, 1.8);
  for (const char* form : {"box-tetrahedra", "two-blocks", "box-wedges"}) {
    const Orders o = converge(form);
    EXPECT_GT(o.all, 1.2);
    EXPECT_GT(o.inside, 1.8);
  }
  for (const char* form : {"box-mixed", "box-polyhedra", "twisted"}) {
    const Orders o = converge(form);
    EXPECT_GT(o.all, 0.9);
    EXPECT_GT(o.inside, 0.9);
  }
}

TEST(Gradients, AreOneSidedAtBoundaries) {
  // A parabola along i: central differences and one-sided ones over two points are exact, the
  // latter alone being asked at the ends.
  const Mesh mesh = generate("box-hexahedra", {4, 0, 1});
  const auto gradients =
      point_gradients(mesh, point_field(mesh, [](const Vector& p) { return p[0] * p[0]; }));
  for (std::size_t p = 0; p < mesh.point_count(); ++p)
    ASSERT_NEAR(gradients[3 * p], 2 * point_at(mesh, p)[0], 1e-6);
  // With one cell there is no third point.
  const Mesh one = generate("box-hexahedra", {1, 0, 1});
  for (const float g :
       point_gradients(one, point_field(one, [](const Vector& p) { return p[0] + p[1] + p[2]; })))
    ASSERT_EQ(g, 1);
}

TEST(Gradients, AreTheSameForAnyNumberOfThreads) {
  for (const char* form : kForms) {
    const Mesh mesh = generate(form, {8, 0.2, 5});
    const ScalarField field = point_field(mesh, smooth);
    std::vector<float> one, two;
    tbb::task_arena(1).execute([&] { one = point_gradients(mesh, field); });
    tbb::task_arena(2).execute([&] { two = point_gradients(mesh, field); });
    EXPECT_EQ(one, two) << form;
  }
}

TEST(Gradients, PassOverValuesThatAreNone) {
  for (const char* form : kForms) {
    const Mesh mesh = generate(form, {5, 0.2, 5});
    ScalarField field = point_field(mesh, linear);
    for (std::size_t p = 3; p < field.values.size(); p += 17) field.values[p] = kNaN;
    const auto gradients = point_gradients(mesh, field);
    std::size_t none = 0;
    for (std::size_t p = 0; p < field.values.size(); ++p) {
      const Vector g = gradient_at(gradients, p);
      if (std::isnan(field.values[p])) {
        ASSERT_TRUE(std::isnan(g[0]) && std::isnan(g[1]) && std::isnan(g[2]));
      } else if (std::isnan(g[0])) {
        ++none;  // a corner, say, of a single cell
      } else {
        for (std::size_t a = 0; a < 3; ++a) ASSERT_NEAR(g[a], kLinear[a], 1e-4) << form << ' ' << p;
      }
    }
    EXPECT_LE(none, 2u) << form;
  }
}

TEST(Gradients, DoNotSeeHiddenCells) {
  Mesh mesh = generate("box-hexahedra", {6, 0.2, 5});
  std::vector<std::uint8_t> hidden(mesh.cell_count(), 0);
  for (std::size_t c = 0; c < hidden.size(); ++c) hidden[c] = c % 6 < 3 && c / 6 % 6 < 3;
  mesh.hidden_cells = Array::own(hidden);
  ScalarField field = point_field(mesh, linear);
  std::vector<bool> seen(mesh.point_count(), false);
  const CellReader cells(mesh);
  std::vector<std::uint32_t> ids;
  for (std::size_t c = 0; c < hidden.size(); ++c) {
    if (hidden[c]) continue;
    cells.points(c, ids);
    for (const std::uint32_t id : ids) seen[id] = true;
  }
  for (std::size_t p = 0; p < seen.size(); ++p)
    if (!seen[p]) field.values[p] = 1e30f;
  const auto gradients = point_gradients(mesh, field);
  for (std::size_t p = 0; p < seen.size(); ++p)
    for (std::size_t a = 0; a < 3; ++a) {
      if (seen[p])
        ASSERT_NEAR(gradients[3 * p + a], kLinear[a], 5e-5);
      else
        ASSERT_TRUE(std::isnan(gradients[3 * p + a]));
    }
}

TEST(Gradients, FindAWayAroundAPole) {
  for (const char* form : {"o-grid", "sphere"}) {
    const Mesh mesh = generate(form, {6, 0, 1});
    const auto gradients = point_gradients(mesh, point_field(mesh, linear));
    std::size_t none = 0;
    for (std::size_t p = 0; p < mesh.point_count(); ++p) {
      if (std::isnan(gradients[3 * p])) {
        ++none;
        continue;
      }
      for (std::size_t a = 0; a < 3; ++a)
        ASSERT_NEAR(gradients[3 * p + a], kLinear[a], 1e-4) << form << ' ' << p;
    }
    EXPECT_EQ(none, 0u) << form;
  }
}

TEST(Gradients, AreNoneWhereNothingTellsThem) {
  // A point of no cell, and a tetrahedron without volume.
  const Mesh mesh = make_mesh(CellType::tetrahedron,
                              {0,          0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, /*apart*/ 7, 7, 7,
                               /*flat*/ 3, 0, 0, 4, 0, 0, 3, 1, 0, 4, 1, 0},
                              {0, 1, 2, 3, 5, 6, 7, 8});
  const auto gradients = point_gradients(mesh, point_field(mesh, linear));
  for (std::size_t p = 0; p < 9; ++p)
    for (std::size_t a = 0; a < 3; ++a) {
      if (p < 4)
        EXPECT_NEAR(gradients[3 * p + a], kLinear[a], 1e-6);
      else
        EXPECT_TRUE(std::isnan(gradients[3 * p + a])) << p;
    }
}

TEST(Gradients, RefuseCellData) {
  const Mesh mesh = generate("box-hexahedra", {2, 0, 1});
  try {
    point_gradients(mesh, cell_field(mesh, linear));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "'of cells' is cell data, which has no gradient at points: average it to the points "
              "first (average_to_points)");
  }
}

TEST(Gradients, OfVoxelsAreThoseOfHexahedra) {
  const Mesh hexahedron = make_mesh(CellType::hexahedron, cube_points(), {0, 1, 2, 3, 4, 5, 6, 7});
  const Mesh voxel = make_mesh(CellType::voxel, cube_points(), {0, 1, 3, 2, 4, 5, 7, 6});
  const auto of_one = point_gradients(hexahedron, point_field(hexahedron, smooth));
  const auto of_other = point_gradients(voxel, point_field(voxel, smooth));
  for (std::size_t i = 0; i < of_one.size(); ++i) EXPECT_NEAR(of_one[i], of_other[i], 1e-6);
  // At a corner the trilinear interpolation's own.
  EXPECT_NEAR(of_one[0], smooth({1, 0, 0}) - smooth({0, 0, 0}), 1e-6);
  EXPECT_NEAR(of_one[1], smooth({0, 1, 0}) - smooth({0, 0, 0}), 1e-6);
}

}  // namespace
}  // namespace plume::test
