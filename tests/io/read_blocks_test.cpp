// Several blocks as one mesh, in cases that no file at hand has.
#include "plume/io/read_blocks.h"

#include "read_test_files.h"

namespace plume::test {
namespace {

Array ids(std::vector<std::int64_t> values) { return Array::own(std::move(values)); }

// A tetrahedron as a polyhedron, with a stray point in front so that ids are no positions.
Mesh polyhedron(float shift) {
  Mesh mesh;
  mesh.points = Array::own(
      std::vector<float>{9, 9, 9, shift, 0, 0, shift + 1, 0, 0, shift, 1, 0, shift, 0, 1});
  mesh.cells.types = Array::own(std::vector<std::uint8_t>{42});
  mesh.cells.offsets = ids({0, 4});
  mesh.cells.connectivity = ids({1, 2, 3, 4});
  mesh.cells.polyhedron_locations = ids({0});
  mesh.cells.polyhedron_faces = ids({4, 3, 1, 3, 2, 3, 1, 2, 4, 3, 2, 3, 4, 3, 1, 4, 3});
  return mesh;
}

Mesh tetrahedron(std::vector<double> points) {
  Mesh mesh;
  mesh.points = Array::own(std::move(points));
  mesh.cells.types = Array::own(std::vector<std::uint8_t>{10});
  mesh.cells.connectivity = ids({0, 1, 2, 3});
  return mesh;
}

Mesh append(std::vector<Mesh> blocks, bool merge = false) {
  return append_blocks(std::move(blocks), merge, "file", {});
}

TEST(Blocks, RenumberTheFacesOfPolyhedra) {
  const Mesh mesh =
      append({polyhedron(0), tetrahedron(std::vector<double>(12, 0.0)), polyhedron(5)});
  EXPECT_EQ(values(mesh.cells.types), (std::vector<double>{42, 10, 42}));
  EXPECT_EQ(values(mesh.cells.offsets), (std::vector<double>{0, 4, 8, 12}));
  EXPECT_EQ(values(mesh.cells.connectivity),
            (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 10, 11, 12, 13}));
  EXPECT_EQ(values(mesh.cells.polyhedron_locations), (std::vector<double>{0, -1, 17}));
  const auto faces = values(mesh.cells.polyhedron_faces);
  EXPECT_EQ(std::vector<double>(faces.begin() + 17, faces.end()),
            (std::vector<double>{4, 3, 10, 12, 11, 3, 10, 11, 13, 3, 11, 12, 13, 3, 10, 13, 12}));
  // Float and double become double.
  EXPECT_EQ(mesh.points.type(), Array::Type::float64);
}

TEST(Blocks, MergePointsAcrossBlocksOnly) {
  // The first two points of a block coincide, as at a pole.
  const std::vector<double> pole{0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  const Mesh mesh = append({tetrahedron(pole), tetrahedron(pole)}, true);
  EXPECT_EQ(mesh.point_count(), 4u);
  EXPECT_EQ(values(mesh.cells.connectivity), (std::vector<double>{0, 1, 2, 3, 0, 0, 2, 3}));
}

TEST(Blocks, MergeOnlyEqualBits) {
  const double near = 0.1 + 0.2;
  const Mesh mesh = append({tetrahedron({0, 0, 0, 0.3, 0, 0, 0, 1, 0, 0, 0, 1}),
                            tetrahedron({-0.0, 0, 0, near, 0, 0, 0, 1, 0, 0, 0, 2})},
                           true);
  // Zero has two signs and one value; 0.3 and 0.1 + 0.2 are two numbers.
  EXPECT_EQ(values(mesh.cells.connectivity), (std::vector<double>{0, 1, 2, 3, 0, 4, 2, 5}));
  EXPECT_EQ(mesh.point_count(), 6u);
}

TEST(Blocks, MergeAfterConversionToOneType) {
  Mesh in_float = tetrahedron({});
  in_float.points = Array::own(std::vector<float>{0.1f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  const Mesh mesh = append({in_float, tetrahedron({0.1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1})}, true);
  // 0.1f is another number than 0.1.
  EXPECT_EQ(mesh.point_count(), 5u);
}

TEST(Blocks, FieldsOfDifferentTypesBecomeDouble) {
  Mesh first = tetrahedron(std::vector<double>(12, 0.0)), second = first;
  first.fields = {{"T", Association::cell, 1, Array::own(std::vector<float>{0.5f})}};
  second.fields = {{"T", Association::cell, 1, Array::own(std::vector<std::int32_t>{7})}};
  const Mesh mesh = append({first, second});
  ASSERT_EQ(mesh.fields.size(), 1u);
  EXPECT_EQ(mesh.fields[0].values.type(), Array::Type::float64);
  EXPECT_EQ(values(mesh.fields[0].values), (std::vector<double>{0.5, 7}));
}

}  // namespace
}  // namespace plume::test
