// Bad files of every format: one line that names the file, nothing printed, nothing crashed.
#include <fstream>
#include <random>

#include "plume/io/write_mesh.h"
#include "plume/mesh/error.h"
#include "read_test_files.h"

namespace plume::test {
namespace {

class BadFile : public FileTest {
 protected:
  void SetUp() override {
    FileTest::SetUp();
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
  }
  void TearDown() override {
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    FileTest::TearDown();
  }

  void expect_error_naming(const std::filesystem::path& file) {
    const std::string message = error_of(file);
    EXPECT_NE(message.find(file.string()), std::string::npos) << message;
  }
};

Mesh two_tetrahedra() {
  Mesh mesh;
  mesh.points = Array::own(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
  mesh.cells.types = Array::own(std::vector<std::uint8_t>{10});
  mesh.cells.connectivity = Array::own(std::vector<std::int32_t>{0, 1, 2, 3, 1, 2, 3, 4});
  mesh.fields.push_back(
      {"T", Association::point, 1, Array::own(std::vector<float>{1, 2, 3, 4, 5})});
  mesh.active_field = "T";
  return mesh;
}

TEST_F(BadFile, IsMissing) {
  for (const std::string& extension : mesh_file_extensions())
    EXPECT_NE(error_of(path("missing" + extension)).find("no such file"), std::string::npos);
}

TEST_F(BadFile, IsADirectory) {
  for (const std::string& extension : mesh_file_extensions()) {
    std::filesystem::create_directory(path("directory" + extension));
    EXPECT_NE(error_of(path("directory" + extension)).find("is a directory"), std::string::npos);
  }
}

TEST_F(BadFile, IsEmpty) {
  for (const std::string& extension : mesh_file_extensions()) {
    // An empty .foam is how OpenFOAM users write it; its directory is what counts.
    const std::string expected = extension == ".foam" ? "system/controlDict" : "is empty";
    EXPECT_NE(error_of(write("empty" + extension, "")).find(expected), std::string::npos);
  }
}

TEST_F(BadFile, HasAnUnknownExtension) {
  const std::string message = error_of(write("mesh.gltf", "{}"));
  EXPECT_NE(message.find("unknown extension '.gltf'"), std::string::npos);
  EXPECT_NE(message.find(".vtu"), std::string::npos);
  EXPECT_NE(error_of(write("mesh", "solid")).find("no extension"), std::string::npos);
}

TEST_F(BadFile, IsGarbage) {
  std::mt19937 random(7);
  for (const std::size_t length : {1u, 7u, 100u, 5000u})
    for (const std::string& extension : mesh_file_extensions()) {
      std::string bytes(length, '\0');
      for (char& byte : bytes) byte = static_cast<char>(random());
      SCOPED_TRACE(std::to_string(length) + extension);
      expect_error_naming(write("garbage" + extension, bytes));
    }
}

TEST_F(BadFile, IsText) {
  for (const std::string& extension : mesh_file_extensions()) {
    SCOPED_TRACE(extension);
    expect_error_naming(write("text" + extension, "Dear all,\nplease find the mesh attached.\n"));
  }
}

TEST_F(BadFile, IsTruncatedAnywhere) {
  for (const std::string extension : {".vtu", ".vtk"}) {
    write_mesh(two_tetrahedra(), path("whole" + extension));
    const std::string whole = contents_of(path("whole" + extension));
    // The last byte is a line's end, which nobody misses. A legacy file that ends between two of
    // its sections is a whole one with fewer sections.
    const std::size_t section = whole.find("POINT_DATA");
    for (std::size_t length = 1; length + 1 < whole.size(); length += 7) {
      if (extension == ".vtk" && length + 1 >= section && length <= section) continue;
      SCOPED_TRACE(extension + " cut to " + std::to_string(length));
      expect_error_naming(write("cut" + extension, whole.substr(0, length)));
    }
  }
}

TEST_F(BadFile, IsXmlOfAnotherKind) {
  expect_error_naming(write("a.vtu", "<VTKFile type=\"UnstructuredGrid\"><Bad></VTKFile>"));
  expect_error_naming(write("b.vtu", "<VTKFile type=\"PolyData\"></VTKFile>"));
}

TEST_F(BadFile, HasNoVolumeCells) {
  const std::string message = error_of(write("surface.vtk",
                                             "# vtk DataFile Version 3.0\nsurface\nASCII\n"
                                             "DATASET UNSTRUCTURED_GRID\nPOINTS 3 float\n"
                                             "0 0 0 1 0 0 0 1 0\nCELLS 2 6\n3 0 1 2\n1 0\n"
                                             "CELL_TYPES 2\n5\n1\n"));
  EXPECT_NE(message.find("no volume cells, only 1 triangle, 1 vertex"), std::string::npos)
      << message;
}

TEST_F(BadFile, HasAFlatGrid) {
  const std::string message =
      error_of(write("flat.vtk",
                     "# vtk DataFile Version 3.0\nflat\nASCII\nDATASET STRUCTURED_GRID\n"
                     "DIMENSIONS 2 2 1\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 1 1 0\n"));
  EXPECT_NE(message.find("no volume cells, only 1 quadrilateral"), std::string::npos) << message;
}

TEST_F(BadFile, UsesAPointThatIsNotThere) {
  const std::string message =
      error_of(write("point.vtk",
                     "# vtk DataFile Version 3.0\npoint\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                     "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 9\n"
                     "CELL_TYPES 1\n10\n"));
  EXPECT_NE(message.find("cell 0 uses point 9 of 4"), std::string::npos) << message;
}

TEST_F(BadFile, HasATetrahedronOfThreePoints) {
  const std::string message =
      error_of(write("three.vtk",
                     "# vtk DataFile Version 3.0\nthree\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                     "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 4\n3 0 1 2\n"
                     "CELL_TYPES 1\n10\n"));
  EXPECT_NE(message.find("cell 0 is a tetrahedron with 3 points"), std::string::npos) << message;
}

TEST_F(BadFile, HasNoSuchTimeStep) {
  write_mesh(two_tetrahedra(), path("a.vtu"));
  const std::string message = error_of(path("a.vtu"), {.time_step = 3});
  EXPECT_NE(message.find("no time step 3; choose one from 0 to 0"), std::string::npos) << message;
}

TEST_F(BadFile, IsGivenASolutionThatItCannotHave) {
  write_mesh(two_tetrahedra(), path("a.vtu"));
  EXPECT_NE(error_of(path("a.vtu"), {.solution = "q.bin"}).find("q.bin: a solution file goes with"),
            std::string::npos);
}

}  // namespace
}  // namespace plume::test
