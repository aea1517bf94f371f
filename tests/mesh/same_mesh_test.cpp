#include "plume/mesh/same_mesh.h"

#include <gtest/gtest.h>

#include <vector>

#include "plume/datasets/generate.h"

namespace plume {
namespace {

// The same values elsewhere in memory.
Array copied(const Array& array) {
  return array.visit([](auto values) {
    using T = std::remove_cv_t<typename decltype(values)::value_type>;
    return Array::own(std::vector<T>(values.begin(), values.end()));
  });
}

// With the lowest bit of one value flipped, or one value where there was none.
Array changed(const Array& array) {
  if (array.empty()) return Array::own(std::vector<std::uint8_t>{1});
  return array.visit([](auto values) {
    using T = std::remove_cv_t<typename decltype(values)::value_type>;
    std::vector<T> copy(values.begin(), values.end());
    reinterpret_cast<std::uint8_t&>(copy[copy.size() / 2]) ^= 1;
    return Array::own(std::move(copy));
  });
}

std::vector<Array*> arrays_of(Mesh& mesh) {
  return {&mesh.points,
          &mesh.axes[0],
          &mesh.axes[1],
          &mesh.axes[2],
          &mesh.cells.types,
          &mesh.cells.offsets,
          &mesh.cells.connectivity,
          &mesh.cells.polyhedron_locations,
          &mesh.cells.polyhedron_faces,
          &mesh.hidden_cells};
}

TEST(SameMesh, IsOneWhosePointsAndCellsAreTheSameBitForBit) {
  for (const char* name :
       {"box-tetrahedra", "box-mixed", "box-polyhedra", "box-hexahedra", "box-rectilinear"}) {
    SCOPED_TRACE(name);
    const Mesh mesh = generate(name, {.size = 3});
    Mesh copy = mesh;
    for (Array* array : arrays_of(copy)) *array = copied(*array);
    copy.fields.clear();
    EXPECT_TRUE(same_points_and_cells(mesh, mesh));
    EXPECT_TRUE(same_points_and_cells(mesh, copy));
    for (std::size_t i = 0; i < arrays_of(copy).size(); ++i) {
      SCOPED_TRACE(i);
      Mesh other = copy;
      *arrays_of(other)[i] = changed(*arrays_of(copy)[i]);
      EXPECT_FALSE(same_points_and_cells(mesh, other));
      EXPECT_FALSE(same_points_and_cells(other, mesh));
    }
    Mesh other = copy;
    other.dimensions[1] += 1;
    EXPECT_FALSE(same_points_and_cells(mesh, other));
  }
}

TEST(SameMesh, HasArraysOfTheSameTypes) {
  Mesh narrow, wide;
  narrow.points = Array::own(std::vector<float>{0, 0, 0, 0});
  wide.points = Array::own(std::vector<double>{0, 0, 0, 0});
  EXPECT_FALSE(same_points_and_cells(narrow, wide));
}

}  // namespace
}  // namespace plume
