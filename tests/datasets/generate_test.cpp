#include "plume/datasets/generate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "plume/mesh/error.h"
#include "plume/tests/datasets/mesh_measures.h"

namespace plume {
namespace {

using namespace measures;

GenerateOptions of_size(int size, double jitter = 0) {
  GenerateOptions options;
  options.size = size;
  options.jitter = jitter;
  return options;
}

bool same(const Array& a, const Array& b) {
  return a.size() == b.size() && a.type() == b.type() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * a.value_bytes()) == 0);
}

const Field& field(const Mesh& mesh, const std::string& name) {
  const auto found = std::find_if(mesh.fields.begin(), mesh.fields.end(),
                                  [&](const Field& f) { return f.name == name; });
  if (found == mesh.fields.end()) throw Error("the test's mesh has no field " + name);
  return *found;
}

class EveryGenerator : public testing::TestWithParam<std::string> {};

TEST_P(EveryGenerator, IdsAreInRangeAndFieldsFit) {
  for (int size : {1, 2, 5}) {
    const Mesh mesh = generate(GetParam(), of_size(size, 0.2));
    const auto points = static_cast<std::int64_t>(mesh.point_count());
    ASSERT_GT(points, 0);
    const auto cells = cells_of(mesh);
    EXPECT_EQ(cells.size(), mesh.cell_count());
    std::set<std::int64_t> used;
    for (const Cell& cell : cells) {
      for (auto id : cell.points) {
        ASSERT_GE(id, 0);
        ASSERT_LT(id, points);
        used.insert(id);
      }
    }
    EXPECT_EQ(static_cast<std::int64_t>(used.size()), points) << "points that no cell uses";
    const bool has_active =
        std::any_of(mesh.fields.begin(), mesh.fields.end(), [&](const Field& f) {
          return f.name == mesh.active_field && f.association == Association::point;
        });
    EXPECT_TRUE(has_active) << mesh.active_field;
    for (const Field& f : mesh.fields) {
      const std::size_t places =
          f.association == Association::point ? mesh.point_count() : mesh.cell_count();
      EXPECT_EQ(f.values.size(), places * static_cast<std::size_t>(f.components)) << f.name;
      for (std::size_t i = 0; i < f.values.size(); ++i) {
        ASSERT_TRUE(std::isfinite(f.values.at<double>(i))) << f.name << " " << i;
      }
    }
  }
}

TEST_P(EveryGenerator, IsReproducible) {
  GenerateOptions options = of_size(4, 0.3);
  options.seed = 7;
  const Mesh a = generate(GetParam(), options), b = generate(GetParam(), options);
  EXPECT_TRUE(same(a.points, b.points));
  EXPECT_TRUE(same(a.cells.connectivity, b.cells.connectivity));
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_TRUE(same(a.axes[axis], b.axes[axis]));
  ASSERT_EQ(a.fields.size(), b.fields.size());
  for (std::size_t i = 0; i < a.fields.size(); ++i) {
    EXPECT_TRUE(same(a.fields[i].values, b.fields[i].values));
  }
}

TEST_P(EveryGenerator, HasPositiveVolumesAndMatchingFaces) {
  for (int size : {1, 2, 5}) {
    const Mesh mesh = generate(GetParam(), of_size(size));
    const FaceCounts counts = count_faces(mesh);
    EXPECT_EQ(counts.mismatched, 0u);
    EXPECT_GT(counts.boundary, 0u);
    // A collapsed corner cell still has volume.
    EXPECT_GT(smallest_volume(mesh), 0) << "size " << size;
  }
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Generator& g : generators()) all.push_back(g.name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Generators, EveryGenerator, testing::ValuesIn(names()),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Generate, NamesAreTheExpectedOnes) {
  EXPECT_EQ(names(), (std::vector<std::string>{
                         "blunt-body", "box-tetrahedra", "box-hexahedra", "box-rectilinear",
                         "box-wedges", "box-mixed", "box-polyhedra", "twisted", "o-grid", "sphere",
                         "ball-tetrahedra", "two-blocks", "nested-shell", "vortex-street"}));
}

TEST(Generate, RefusesWhatItCannotMake) {
  const auto message = [](const std::string& name, const GenerateOptions& options) {
    try {
      generate(name, options);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("nothing thrown");
  };
  EXPECT_NE(message("teapot", {}).find("'teapot'"), std::string::npos);
  EXPECT_NE(message("teapot", {}).find("box-mixed"), std::string::npos);
  EXPECT_NE(message("box-wedges", of_size(-3)).find("-3"), std::string::npos);
  EXPECT_NE(message("box-wedges", of_size(2, -1)).find("jitter"), std::string::npos);
  EXPECT_NE(message("box-wedges", of_size(2, std::nan(""))).find("jitter"), std::string::npos);
  // Each would overflow 32-bit ids; each must say so before it allocates anything.
  for (const auto& name : names()) {
    EXPECT_NE(message(name, of_size(2000000000)).find("smaller size"), std::string::npos) << name;
  }
  EXPECT_NE(message("box-tetrahedra", of_size(1290)).find("1290"), std::string::npos);
}

TEST(Generate, BoxesFillTheUnitCube) {
  for (const char* name : {"box-tetrahedra", "box-hexahedra", "box-rectilinear", "box-wedges",
                           "box-mixed", "box-polyhedra", "twisted", "two-blocks", "nested-shell"}) {
    // Where faces match and the boundary is fixed, jitter moves volume but does not change its sum.
    for (double jitter : {0.0, 0.2, 3.0}) {
      EXPECT_NEAR(total_volume(generate(name, of_size(6, jitter))), 1, 1e-6) << name << jitter;
    }
    const double area = std::string(name) == "two-blocks" ? 8 : 6;
    EXPECT_NEAR(boundary_area(generate(name, of_size(6))), area, 1e-5) << name;
  }
}

TEST(Generate, JitterMovesInteriorPointsOnlyAndBySeed) {
  const Mesh rest = generate("box-tetrahedra", of_size(8));
  GenerateOptions options = of_size(8, 0.25);
  const Mesh moved = generate("box-tetrahedra", options);
  options.seed = 2;
  EXPECT_FALSE(same(moved.points, generate("box-tetrahedra", options).points));
  double farthest = 0;
  for (std::size_t i = 0; i < rest.point_count(); ++i) {
    const Vector p = point(rest, static_cast<std::int64_t>(i));
    const Vector q = point(moved, static_cast<std::int64_t>(i));
    const bool inside = std::all_of(p.begin(), p.end(), [](double x) { return x > 0 && x < 1; });
    for (std::size_t a = 0; a < 3; ++a) {
      if (!inside) {
        EXPECT_EQ(p[a], q[a]);
      }
      farthest = std::max(farthest, std::abs(p[a] - q[a]));
    }
  }
  EXPECT_LE(farthest, 0.25 / 8 + 1e-7);
  EXPECT_GT(farthest, 0.2 / 8);
}

TEST(Generate, FirstRandomPointIsTheSameOnEveryMachine) {
  const Mesh mesh = generate("box-hexahedra", of_size(2, 0.2));
  // The middle point, number 13, with seed 1, by an independent splitmix64 (Python, integers).
  EXPECT_EQ(mesh.points.at<float>(39), 0x1.1ed6c60000000p-1f);
}

TEST(Generate, LargeJitterInvertsCells) {
  EXPECT_LT(smallest_volume(generate("box-tetrahedra", of_size(6, 2.0))), 0);
}

TEST(Generate, BoxCountsAreAsDocumented) {
  const Mesh tetrahedra = generate("box-tetrahedra", of_size(4));
  EXPECT_EQ(tetrahedra.cell_count(), 6u * 64);
  EXPECT_EQ(tetrahedra.point_count(), 125u);
  EXPECT_EQ(tetrahedra.cells.types.size(), 1u);
  EXPECT_TRUE(tetrahedra.cells.offsets.empty());
  EXPECT_EQ(tetrahedra.cells.connectivity.type(), Array::Type::int32);
  EXPECT_EQ(tetrahedra.points.type(), Array::Type::float32);
  EXPECT_EQ(generate("box-hexahedra", of_size(4)).cell_count(), 64u);
  EXPECT_EQ(generate("box-wedges", of_size(4)).cell_count(), 128u);
  EXPECT_EQ(generate("two-blocks", of_size(4)).cell_count(), 64u);
  EXPECT_EQ(generate("two-blocks", of_size(4)).point_count(), 150u);
  EXPECT_EQ(generate("ball-tetrahedra", of_size(4)).cell_count(), 8u * 64);
  EXPECT_EQ(generate("ball-tetrahedra", of_size(4)).point_count(), 129u);
  EXPECT_EQ(generate("blunt-body").dimensions, (std::array<std::int64_t, 3>{64, 48, 48}));
  EXPECT_EQ(generate("twisted").cell_count(), 56u * 56 * 56);
}

TEST(Generate, PlanesOfARectilinearBoxKeepTheirOrder) {
  const auto planes = [](const GenerateOptions& options) {
    const Mesh mesh = generate("box-rectilinear", options);
    EXPECT_TRUE(mesh.points.empty());
    return mesh.axes[1].visit([](auto v) { return std::vector<double>(v.begin(), v.end()); });
  };
  EXPECT_EQ(planes(of_size(4)), (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  for (const double jitter : {0.2, 3.0}) {
    const auto moved = planes(of_size(40, jitter));
    double farthest = 0;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      if (i > 0) {
        EXPECT_GT(moved[i], moved[i - 1]);
      }
      farthest = std::max(farthest, std::abs(moved[i] * 40 - static_cast<double>(i)));
    }
    EXPECT_EQ(moved.front(), 0);
    EXPECT_EQ(moved.back(), 1);
    EXPECT_LE(farthest, std::min(jitter, 0.45) + 1e-12);
    EXPECT_GT(farthest, 0.15);
  }
}

TEST(Generate, BoxFieldsAreWhatTheyAreCalled) {
  const Mesh mesh = generate("box-tetrahedra", of_size(4, 0.2));
  const auto id = std::int64_t{62};
  const Vector p = point(mesh, id);
  EXPECT_FLOAT_EQ(field(mesh, "linear").values.at<float>(62),
                  static_cast<float>(p[0] + 2 * p[1] + 3 * p[2]));
  EXPECT_FLOAT_EQ(field(mesh, "radius").values.at<float>(62),
                  static_cast<float>(std::hypot(p[0] - 0.5, p[1] - 0.5, p[2] - 0.5)));
  for (const char* name : {"box-tetrahedra", "box-hexahedra", "box-rectilinear"}) {
    const Mesh m = generate(name, of_size(4, 0.2));
    const auto cells = cells_of(m);
    ASSERT_EQ(field(m, "cell_radius").association, Association::cell);
    for (std::size_t c : {std::size_t{0}, cells.size() / 2, cells.size() - 1}) {
      Vector mean{0, 0, 0};
      for (auto i : cells[c].points) {
        for (std::size_t a = 0; a < 3; ++a) {
          mean[a] += point(m, i)[a] / static_cast<double>(cells[c].points.size());
        }
      }
      EXPECT_FLOAT_EQ(field(m, "cell_radius").values.at<float>(c),
                      static_cast<float>(std::hypot(mean[0] - 0.5, mean[1] - 0.5, mean[2] - 0.5)));
    }
  }
}

TEST(Generate, MixedHasAllFourTypes) {
  for (int size : {2, 3, 8}) {
    std::map<CellType, int> counts;
    for (const Cell& cell : cells_of(generate("box-mixed", of_size(size)))) ++counts[cell.type];
    EXPECT_EQ(counts.size(), 4u) << size;
    EXPECT_GT(counts[CellType::pyramid], 0);
  }
}

TEST(Generate, PolyhedraHaveHexagons) {
  const Mesh mesh = generate("box-polyhedra", of_size(5));
  std::map<std::size_t, int> corners;
  for (const Cell& cell : cells_of(mesh)) {
    for (const auto& face : cell.faces) ++corners[face.size()];
    std::set<std::int64_t> in_faces;
    for (const auto& face : cell.faces) in_faces.insert(face.begin(), face.end());
    EXPECT_EQ(in_faces, std::set<std::int64_t>(cell.points.begin(), cell.points.end()));
  }
  EXPECT_GT(corners[6], corners[5]);
  EXPECT_GT(corners[4], 0);
}

TEST(Generate, HexahedraHavePositiveJacobians) {
  for (const char* name : {"box-hexahedra", "twisted", "two-blocks"}) {
    EXPECT_GT(smallest_jacobian(generate(name, of_size(8))), 0) << name;
  }
  for (int size : {1, 7, 63}) {
    EXPECT_GT(smallest_jacobian(generate("blunt-body", of_size(size))), 0) << size;
  }
}

TEST(Generate, EveryInteriorFaceOfTwistedIsTwisted) {
  const int size = 6;
  const Mesh mesh = generate("twisted", of_size(size));
  int twisted_faces = 0;
  for (const Cell& cell : cells_of(mesh)) {
    for (const auto& face : cell.faces) {
      const Vector p = point(mesh, face[0]);
      const double six =
          determinant(point(mesh, face[1]) - p, point(mesh, face[2]) - p, point(mesh, face[3]) - p);
      bool on_boundary = false;
      for (std::size_t a = 0; a < 3; ++a) {
        for (double wall : {0.0, 1.0}) {
          on_boundary = on_boundary || std::all_of(face.begin(), face.end(), [&](auto id) {
                          return point(mesh, id)[a] == wall;
                        });
        }
      }
      if (on_boundary) {
        EXPECT_EQ(six, 0);
      } else {
        // Four corners at +-0.18 edges span at least a third of an edge cubed.
        EXPECT_GT(std::abs(six) * size * size * size, 0.3);
        ++twisted_faces;
      }
    }
  }
  EXPECT_EQ(twisted_faces, 2 * 3 * size * size * (size - 1));
}

/// True where two points of a grid have the same bits.
bool coincide(const Mesh& mesh, std::int64_t a, std::int64_t b) {
  const auto* bytes = static_cast<const char*>(mesh.points.data());
  const auto stride = 3 * static_cast<std::int64_t>(mesh.points.value_bytes());
  return std::memcmp(bytes + a * stride, bytes + b * stride, static_cast<std::size_t>(stride)) == 0;
}

TEST(Generate, OGridCollapsesOnItsAxisAndCloses) {
  const Mesh mesh = generate("o-grid", of_size(5));
  const auto [ni, nj, nk] = mesh.dimensions;
  ASSERT_EQ(nj, 21);
  for (std::int64_t k = 0; k < nk; ++k) {
    for (std::int64_t j = 0; j < nj; ++j) {
      EXPECT_TRUE(coincide(mesh, ni * nj * k, ni * (j + nj * k)));
      EXPECT_EQ(coincide(mesh, ni * nj * k + 1, ni * (j + nj * k) + 1), j == 0 || j == nj - 1);
    }
    for (std::int64_t i = 0; i < ni; ++i) {
      EXPECT_TRUE(coincide(mesh, i + ni * nj * k, i + ni * (nj - 1 + nj * k)));
    }
  }
  // A prism over a regular polygon of 20 corners, circumradius 1/2.
  EXPECT_NEAR(total_volume(mesh), 20 / 2 * 0.25 * std::sin(2 * std::numbers::pi / 20), 1e-12);
}

TEST(Generate, SphereCollapsesAndCloses) {
  const Mesh mesh = generate("sphere", of_size(4));
  const auto [ni, nj, nk] = mesh.dimensions;
  for (std::int64_t k = 0; k < nk; ++k) {
    for (std::int64_t j = 0; j < nj; ++j) EXPECT_TRUE(coincide(mesh, 0, ni * (j + nj * k)));
    for (std::int64_t i = 0; i < ni; ++i) {
      for (std::int64_t j : {std::int64_t{0}, nj - 1}) {
        EXPECT_TRUE(coincide(mesh, i + ni * j, i + ni * (j + nj * k))) << i << " " << k;
      }
    }
  }
  for (std::int64_t p = 0; p < ni * nj; ++p) {
    EXPECT_TRUE(coincide(mesh, p, p + ni * nj * (nk - 1)));
  }
}

TEST(Generate, BallsConvergeToABallAtSecondOrder) {
  const double exact = 4.0 / 3 * std::numbers::pi;
  for (const char* name : {"sphere", "ball-tetrahedra"}) {
    const double coarse = exact - total_volume(generate(name, of_size(6)));
    const double fine = exact - total_volume(generate(name, of_size(12)));
    EXPECT_GT(fine, 0) << name;
    EXPECT_NEAR(coarse / fine, 4, 0.25) << name;
  }
  EXPECT_GT(smallest_volume(generate("ball-tetrahedra", of_size(12))), 0);
}

TEST(Generate, TwoBlocksMeetAtTheSamePlaces) {
  const Mesh mesh = generate("two-blocks", of_size(4, 0.2));
  std::map<Vector, int> at_the_middle;
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(mesh.point_count()); ++i) {
    if (point(mesh, i)[0] == 0.5) ++at_the_middle[point(mesh, i)];
  }
  int duplicated = 0;
  for (const auto& [place, count] : at_the_middle) duplicated += count == 2;
  EXPECT_EQ(duplicated, 25);
}

TEST(Generate, BluntBodyHasABowShock) {
  const Mesh mesh = generate("blunt-body");
  const std::int64_t ni = mesh.dimensions[0], nj = mesh.dimensions[1], nk = mesh.dimensions[2];
  const auto density = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    return field(mesh, "density")
        .values.at<double>(static_cast<std::size_t>(i + ni * (j + nj * k)));
  };
  // Ahead of the fin, high above the plate: freestream outside, Rankine-Hugoniot's 3.81 (at Mach
  // 2.95) or somewhat more within, the rise spread over two to six cells.
  const std::int64_t nose = ni / 2, top = nk - 1;
  EXPECT_NEAR(density(nose, nj - 1, top), 1, 0.02);
  double peak = 0;
  for (std::int64_t j = 0; j < nj; ++j) peak = std::max(peak, density(nose, j, top));
  EXPECT_GT(peak, 3.6);
  EXPECT_LT(peak, 4.6);
  int in_the_rise = 0;
  for (std::int64_t j = nj / 4; j < nj; ++j) {
    in_the_rise += density(nose, j, top) > 1.3 && density(nose, j, top) < 3.4;
  }
  EXPECT_GE(in_the_rise, 2);
  EXPECT_LE(in_the_rise, 6);
  // Over the shoulder the gas expands; beside the fin it is thinner than the freestream.
  EXPECT_LT(density(0, nj / 6, top), 1);
  // Mirror symmetry, of the field and of the grid.
  for (std::int64_t j = 0; j < nj; j += 5) {
    EXPECT_NEAR(density(3, j, 7), density(ni - 4, j, 7), 1e-5);
  }
  for (std::size_t p = 0; p < mesh.point_count(); ++p) {
    ASSERT_GT(field(mesh, "density").values.at<float>(p), 0);
    ASSERT_GT(field(mesh, "pressure").values.at<float>(p), 0);
  }
}

TEST(Generate, NestedShellHasItsShells) {
  const Mesh mesh = generate("nested-shell", of_size(32));
  const Field& f = field(mesh, "attenuation");
  double low = 1e9, high = -1e9;
  for (std::size_t i = 0; i < f.values.size(); ++i) {
    low = std::min(low, f.values.at<double>(i));
    high = std::max(high, f.values.at<double>(i));
  }
  EXPECT_NEAR(low, 0, 1e-6);
  EXPECT_NEAR(high, 1, 0.02);
  // Air in the corner, brain in the middle.
  EXPECT_EQ(f.values.at<float>(0), 0);
  EXPECT_NEAR(f.values.at<double>(16 + 33 * (16 + 33 * 16)), 0.5, 1e-5);
}

// Half a period later, the wake is its mirror image; a whole one later, itself. Its grid stays.
TEST(VortexStreet, ShedsFromBothSidesInTurn) {
  GenerateOptions options = of_size(12);
  const double period = generator_named("vortex-street").period;
  for (const double time : {0.0, 0.7, 3.9}) {
    options.time = time;
    const Mesh now = generate("vortex-street", options);
    options.time = time + period;
    const Mesh again = generate("vortex-street", options);
    options.time = time + period / 2;
    const Mesh mirrored = generate("vortex-street", options);
    EXPECT_TRUE(same(now.points, mirrored.points));
    const Array &a = field(now, "vorticity").values, &b = field(again, "vorticity").values,
                &m = field(mirrored, "vorticity").values;
    const auto [ni, nj, nk] = now.dimensions;
    float greatest = 0;
    for (std::int64_t k = 0; k < nk; ++k)
      for (std::int64_t j = 0; j < nj; ++j)
        for (std::int64_t i = 0; i < ni; ++i) {
          const auto p = static_cast<std::size_t>(i + ni * (j + nj * k));
          const auto q = static_cast<std::size_t>(i + ni * (nj - 1 - j + nj * k));
          // Values are of the order of 1, in single precision.
          ASSERT_NEAR(a.at<float>(p), b.at<float>(p), 1e-5);
          ASSERT_NEAR(a.at<float>(p), -m.at<float>(q), 1e-5);
          greatest = std::max(greatest, a.at<float>(p));
        }
    EXPECT_GT(greatest, 0.5);
  }
  options.time = INFINITY;
  EXPECT_THROW(generate("vortex-street", options), Error);
}

}  // namespace
}  // namespace plume
