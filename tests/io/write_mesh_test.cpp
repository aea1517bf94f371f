// Meshes written and read back.
#include "plume/io/write_mesh.h"

#include "plume/mesh/error.h"
#include "read_test_files.h"

namespace plume::test {
namespace {

using MeshFile = FileTest;

// One cell of each type with a fixed number of points, each on points of its own.
Mesh one_of_each() {
  Mesh mesh;
  std::vector<std::uint8_t> types;
  std::vector<std::int64_t> offsets{0}, ids;
  std::vector<double> points;
  std::vector<std::int32_t> numbers;
  for (const auto type :
       {CellType::tetrahedron, CellType::voxel, CellType::hexahedron, CellType::wedge,
        CellType::pyramid, CellType::pentagonal_prism, CellType::hexagonal_prism}) {
    types.push_back(static_cast<std::uint8_t>(type));
    for (int i = 0; i < points_per_cell(type); ++i) {
      ids.push_back(static_cast<std::int64_t>(ids.size()));
      for (int axis = 0; axis < 3; ++axis)
        points.push_back(0.1 * static_cast<double>(points.size()) + axis);
    }
    offsets.push_back(static_cast<std::int64_t>(ids.size()));
    numbers.push_back(100 + static_cast<std::int32_t>(types.size()));
  }
  std::vector<float> temperature(points.size() / 3);
  for (std::size_t i = 0; i < temperature.size(); ++i)
    temperature[i] = 0.5f * static_cast<float>(i);
  mesh.fields = {{"velocity", Association::point, 3, Array::own(points)},
                 {"temperature", Association::point, 1, Array::own(std::move(temperature))},
                 {"number", Association::cell, 1, Array::own(std::move(numbers))}};
  mesh.active_field = "temperature";
  mesh.points = Array::own(std::move(points));
  mesh.cells.types = Array::own(std::move(types));
  mesh.cells.offsets = Array::own(std::move(offsets));
  mesh.cells.connectivity = Array::own(std::move(ids));
  return mesh;
}

Mesh grid() {
  Mesh mesh;
  mesh.dimensions = {3, 2, 4};
  std::vector<float> points;
  std::vector<double> height;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 3; ++i) {
        for (const int x : {i, 2 * j, k})
          points.push_back(static_cast<float>(x) + 0.1f * static_cast<float>(k));
        height.push_back(k);
      }
  mesh.points = Array::own(std::move(points));
  mesh.fields = {{"height", Association::point, 1, Array::own(std::move(height))},
                 {"id", Association::cell, 1, Array::own(std::vector<float>{0, 1, 2, 3, 4, 5})}};
  mesh.active_field = "height";
  return mesh;
}

void expect_same_fields(const Mesh& mesh, const Mesh& expected) {
  ASSERT_EQ(mesh.fields.size(), expected.fields.size());
  for (const Field& wanted : expected.fields) {
    const Field* const got = field(mesh, wanted.name);
    ASSERT_NE(got, nullptr);
    EXPECT_EQ(got->association, wanted.association);
    EXPECT_EQ(got->components, wanted.components);
    EXPECT_EQ(got->values.type(), wanted.values.type()) << wanted.name;
    EXPECT_EQ(values(got->values), values(wanted.values)) << wanted.name;
  }
  EXPECT_EQ(mesh.active_field, expected.active_field);
}

TEST_F(MeshFile, KeepsEveryTypeOfCellAndField) {
  const Mesh mesh = one_of_each();
  for (const std::string extension : {".vtu", ".vtk"}) {
    SCOPED_TRACE(extension);
    write_mesh(mesh, path("each" + extension));
    const Mesh back = read_mesh(path("each" + extension));
    EXPECT_EQ(values(back.points), values(mesh.points));
    EXPECT_EQ(back.points.type(), Array::Type::float64);
    EXPECT_EQ(values(back.cells.types), values(mesh.cells.types));
    EXPECT_EQ(values(back.cells.offsets), values(mesh.cells.offsets));
    EXPECT_EQ(values(back.cells.connectivity), values(mesh.cells.connectivity));
    expect_same_fields(back, mesh);
  }
}

TEST_F(MeshFile, KeepsCellsWithoutOffsetsThatWay) {
  Mesh mesh;
  mesh.points = Array::own(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
  mesh.cells.types = Array::own(std::vector<std::uint8_t>{10});
  mesh.cells.connectivity = Array::own(std::vector<std::int32_t>{0, 1, 2, 3, 1, 2, 3, 4});
  for (const std::string extension : {".vtu", ".vtk"}) {
    SCOPED_TRACE(extension);
    write_mesh(mesh, path("two" + extension));
    const Mesh back = read_mesh(path("two" + extension));
    EXPECT_EQ(back.cell_count(), 2u);
    EXPECT_EQ(back.cells.types.size(), 1u);
    EXPECT_TRUE(back.cells.offsets.empty());
    EXPECT_EQ(values(back.cells.connectivity), values(mesh.cells.connectivity));
  }
}

TEST_F(MeshFile, MixesWidthsOfIds) {
  Mesh mesh = one_of_each();
  const auto ids = values(mesh.cells.connectivity);
  mesh.cells.connectivity = Array::own(std::vector<std::int32_t>(ids.begin(), ids.end()));
  write_mesh(mesh, path("mixed.vtu"));
  EXPECT_EQ(values(read_mesh(path("mixed.vtu")).cells.connectivity), ids);
}

TEST_F(MeshFile, KeepsPolyhedra) {
  Mesh mesh;
  // A cube as a polyhedron, and a tetrahedron on three of its points.
  mesh.points = Array::own(std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0,
                                               1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 0, 0, 2});
  mesh.cells.types = Array::own(std::vector<std::uint8_t>{10, 42});
  mesh.cells.offsets = Array::own(std::vector<std::int64_t>{0, 4, 12});
  mesh.cells.connectivity =
      Array::own(std::vector<std::int64_t>{4, 5, 6, 8, 0, 1, 2, 3, 4, 5, 6, 7});
  mesh.cells.polyhedron_locations = Array::own(std::vector<std::int64_t>{-1, 0});
  const std::vector<std::int64_t> faces{6, 4, 0, 3, 2, 1, 4, 4, 5, 6, 7, 4, 0, 1, 5, 4,
                                        4, 1, 2, 6, 5, 4, 2, 3, 7, 6, 4, 3, 0, 4, 7};
  mesh.cells.polyhedron_faces = Array::own(faces);
  write_mesh(mesh, path("polyhedra.vtu"));
  const Mesh back = read_mesh(path("polyhedra.vtu"));
  EXPECT_EQ(values(back.cells.types), (std::vector<double>{10, 42}));
  ASSERT_EQ(back.cells.polyhedron_locations.size(), 2u);
  EXPECT_EQ(back.cells.polyhedron_locations.at<int>(0), -1);
  const auto at = back.cells.polyhedron_locations.at<std::size_t>(1);
  const auto stream = values(back.cells.polyhedron_faces);
  ASSERT_EQ(stream.size(), at + faces.size());
  EXPECT_EQ(std::vector<double>(stream.begin() + static_cast<std::ptrdiff_t>(at), stream.end()),
            std::vector<double>(faces.begin(), faces.end()));
}

TEST_F(MeshFile, AGridStaysAGridUnlessWrittenAsCells) {
  const Mesh mesh = grid();
  for (const std::string extension : {".vts", ".vtk"}) {
    SCOPED_TRACE(extension);
    write_mesh(mesh, path("grid" + extension));
    const Mesh back = read_mesh(path("grid" + extension));
    EXPECT_EQ(back.dimensions, mesh.dimensions);
    EXPECT_EQ(values(back.points), values(mesh.points));
    expect_same_fields(back, mesh);
  }
  write_mesh(mesh, path("grid.vtu"));
  const Mesh cells = read_mesh(path("grid.vtu"));
  EXPECT_FALSE(cells.is_grid());
  EXPECT_EQ(cells.cell_count(), 6u);
  EXPECT_EQ(cells.cells.types.at<int>(0), 12);
  // The first cell's corners in VTK's order.
  const auto ids = values(cells.cells.connectivity);
  EXPECT_EQ(std::vector<double>(ids.begin(), ids.begin() + 8),
            (std::vector<double>{0, 1, 4, 3, 6, 7, 10, 9}));
  expect_same_fields(cells, mesh);
}

TEST_F(MeshFile, HiddenCellsStayHidden) {
  Mesh mesh = grid();
  mesh.hidden_cells = Array::own(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1});
  for (const std::string extension : {".vts", ".vtk"}) {
    SCOPED_TRACE(extension);
    write_mesh(mesh, path("hidden" + extension));
    EXPECT_EQ(values(read_mesh(path("hidden" + extension)).hidden_cells),
              (std::vector<double>{0, 1, 0, 0, 0, 1}));
  }
  write_mesh(mesh, path("hidden.vtu"));
  const Read cells = read(path("hidden.vtu"));
  EXPECT_EQ(cells.mesh.cell_count(), 4u);
  EXPECT_EQ(values(field(cells.mesh, "id")->values), (std::vector<double>{0, 2, 3, 4}));
  EXPECT_TRUE(cells.was_told("2 of the cells dropped"));
}

TEST_F(MeshFile, IsReplacedAndLeavesNothingBeside) {
  write_mesh(one_of_each(), path("a.vtu"));
  write_mesh(grid(), path("a.vtu"));
  EXPECT_EQ(read_mesh(path("a.vtu")).cell_count(), 6u);
  int files = 0;
  for ([[maybe_unused]] const auto& entry :
       std::filesystem::directory_iterator(path("a.vtu").parent_path()))
    ++files;
  EXPECT_EQ(files, 1);
}

std::string write_error(const Mesh& mesh, const std::filesystem::path& file) {
  try {
    write_mesh(mesh, file);
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << file << " was written";
  return {};
}

TEST_F(MeshFile, RefusesWhatItCannotWrite) {
  EXPECT_NE(write_error(grid(), path("a.stl")).find("name it .vtu, .vts, .vtr, .vti or .vtk"),
            std::string::npos);
  EXPECT_NE(write_error(one_of_each(), path("a.vts")).find("a.vts: .vts holds a structured grid"),
            std::string::npos);
  EXPECT_NE(write_error(grid(), path("no/such/a.vtu")).find("there is no folder"),
            std::string::npos);
  std::filesystem::create_directory(path("d.vtu"));
  EXPECT_NE(write_error(grid(), path("d.vtu")).find("is a folder"), std::string::npos);
}

}  // namespace
}  // namespace plume::test
