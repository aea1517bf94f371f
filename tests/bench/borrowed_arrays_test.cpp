// Arrays that are borrowed are not copied: by their addresses, and by the memory that a scene
// takes.

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/tests/bench/counted_memory.h"

namespace plume::bench {
namespace {

// What a solver holds, in the types of its choice.
template <class Real, class Id>
struct Solver {
  std::vector<Real> points, pressure;
  std::vector<Id> tetrahedra;

  Solver() {
    const Mesh mesh = generate("box-tetrahedra", {20, 0.2, 1});
    auto copy = [](const Array& from, auto& to) {
      from.visit([&](auto values) { to.assign(values.begin(), values.end()); });
    };
    copy(mesh.points, points);
    copy(mesh.cells.connectivity, tetrahedra);
    copy(mesh.fields[1].values, pressure);
  }
  Mesh borrowed() const {
    Mesh mesh;
    mesh.points = Array::borrow(std::span<const Real>(points));
    mesh.cells.types = Array::own(std::vector<std::uint8_t>{10});
    mesh.cells.connectivity = Array::borrow(std::span<const Id>(tetrahedra));
    mesh.fields.push_back(
        {"pressure", Association::point, 1, Array::borrow(std::span<const Real>(pressure))});
    return mesh;
  }
  std::size_t bytes() const {
    return (points.size() + pressure.size()) * sizeof(Real) + tetrahedra.size() * sizeof(Id);
  }
};

// The most that making a scene takes at once.
template <class Real, class Id>
std::size_t peak_of_scene(const Solver<Real, Id>& solver) {
  const Mesh mesh = solver.borrowed();
  const std::size_t before = counted_bytes();
  forget_peak();
  const Scene scene(mesh);
  return counted_peak() - before;
}

TEST(BorrowedArrays, AreReadWhereTheyAre) {
  const Solver<double, std::int64_t> solver;
  const std::size_t before = counted_bytes();
  const Mesh mesh = solver.borrowed();
  const Mesh copy = mesh;
  EXPECT_EQ(copy.points.data(), solver.points.data());
  EXPECT_EQ(copy.cells.connectivity.data(), solver.tetrahedra.data());
  EXPECT_EQ(copy.fields[0].values.data(), solver.pressure.data());
  EXPECT_LT(counted_bytes() - before, 1024u);
}

// Had any of the arrays been copied or converted on the way, it would show: they are twice as large
// in the wide types.
TEST(BorrowedArrays, TakeTheSameMemoryToMakeASceneOfWhateverTheirTypes) {
  const Solver<float, std::int32_t> narrow;
  const Solver<double, std::int64_t> wide;
  constexpr std::size_t kNoise = 64 * 1024;  // what threads take, and scratch for each
  ASSERT_GT(wide.points.size() * sizeof(double) / 2, kNoise);
  ASSERT_GT(wide.bytes() - narrow.bytes(), 10 * kNoise);
  peak_of_scene(narrow);  // what is made once and kept: threads, Embree's device
  EXPECT_NEAR(static_cast<double>(peak_of_scene(wide)), static_cast<double>(peak_of_scene(narrow)),
              kNoise);
}

TEST(BorrowedArrays, ANewFieldTakesNoMoreThanItsValues) {
  const Solver<double, std::int64_t> solver;
  const Mesh mesh = solver.borrowed();
  SceneOptions options;
  options.keep_field_order = true;
  Scene scene(mesh, options);
  scene.set_field(mesh);
  const std::size_t points = mesh.point_count(), before = counted_bytes();
  forget_peak();
  scene.set_field(mesh);
  // One float a point, and a sample of up to 200,000 of them for the default colour map; nothing
  // that is as large as the mesh.
  EXPECT_LT(counted_peak() - before, 8 * points + 64 * 1024);
  EXPECT_LT(8 * points + 64 * 1024, scene.bytes() / 8);
  EXPECT_NEAR(static_cast<double>(counted_bytes()), static_cast<double>(before), 4096);
}

}  // namespace
}  // namespace plume::bench
