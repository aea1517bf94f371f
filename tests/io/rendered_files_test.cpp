// Simulations' files through the command: the same pictures as of the same cells in VTK's own.
#include <vtkCellData.h>
#include <vtkExodusIIWriter.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "plume/datasets/generate.h"
#include "plume/io/image_file.h"
#include "plume/io/write_mesh.h"
#include "read_test_files.h"

namespace plume::test {
namespace {

class RenderedFile : public OpenFoamCase {
 protected:
  // Runs `plume render FILE OPTIONS` and reads the picture; of no pixels where that fails.
  Image picture(const std::string& file, const std::string& options) const {
    const std::string name = path("picture.exr").string();
    std::filesystem::remove(name);
    const std::string command = std::string(PLUME_COMMAND) + " render '" + path(file).string() +
                                "' --quiet --size 96x96 -o '" + name + "' " + options;
    if (std::system(command.c_str()) != 0) {
      ADD_FAILURE() << command;
      return {};
    }
    return read_image(name);
  }

  // Expects two pictures of the same thing, in which something is seen.
  void expect_alike(const std::string& file, const std::string& other, const std::string& options,
                    float difference) const {
    SCOPED_TRACE(file + " " + options);
    const Image a = picture(file, options), b = picture(other, options);
    ASSERT_EQ(a.rgba.size(), 96u * 96u * 4u);
    ASSERT_EQ(b.rgba.size(), a.rgba.size());
    float most = 0, alpha = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
      most = std::max(most, std::abs(a.rgba[i] - b.rgba[i]));
    for (std::size_t i = 3; i < a.rgba.size(); i += 4) alpha = std::max(alpha, a.rgba[i]);
    EXPECT_LE(most, difference);
    EXPECT_GT(alpha, 0.25f);
  }
};

// Hexahedra, wedges, pyramids and tetrahedra, in blocks of one kind, of which some are cut in two.
TEST_F(RenderedFile, OfMixedCellsInExodusBlocks) {
  write_mesh(generate("box-mixed", {5, 0.2, 3}), path("mixed.vtu"));
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path("mixed.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid* const grid = reader->GetOutput();
  vtkNew<vtkIntArray> block;
  block->SetName("block");
  std::set<int> blocks;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    double box[6];
    grid->GetCellBounds(cell, box);
    const int number = 2 * grid->GetCellType(cell) + (box[0] + box[1] < 1 ? 0 : 1);
    block->InsertNextValue(number);
    blocks.insert(number);
  }
  ASSERT_GT(blocks.size(), 4u);
  grid->GetCellData()->AddArray(block);
  vtkNew<vtkExodusIIWriter> writer;
  writer->SetFileName(path("mixed.exo").c_str());
  writer->SetInputData(grid);
  writer->SetBlockIdArrayName("block");
  writer->SetStoreDoubles(1);
  ASSERT_EQ(writer->Write(), 1);

  const Mesh mesh = read_mesh(path("mixed.exo"));
  std::set<double> kinds;
  for (const double type : values(mesh.cells.types)) kinds.insert(type);
  EXPECT_EQ(kinds, (std::set<double>{10, 12, 13, 14}));
  expect_alike("mixed.exo", "mixed.vtu", "--field waves --merge-points", 1e-6f);
  expect_alike("mixed.exo", "mixed.vtu", "--field waves --merge-points --order 3 --view +y", 1e-6f);
  // Points that are there twice count twice for the default opacities; the cells are the same.
  expect_alike("mixed.exo", "mixed.vtu", "--field linear --mode integral --gray-range 0,10", 1e-6f);
}

// Along x there are the polyhedron and one of two half cubes.
TEST_F(RenderedFile, OfAnOpenFoamCaseWithAPolyhedron) {
  write_case();
  const Image image =
      picture("case", "--field p --view +x --parallel --mode integral --gray-range 0,100");
  ASSERT_EQ(image.rgba.size(), 96u * 96u * 4u);
  std::set<int> seen;
  const Channel* const integral = image.channel("integral");
  ASSERT_NE(integral, nullptr);
  for (const float value : integral->values)
    if (value > 1) {
      EXPECT_NEAR(value, std::round(value), 1e-4);
      seen.insert(static_cast<int>(std::round(value)));
    }
  EXPECT_EQ(seen, (std::set<int>{11 + 21, 11 + 31}));
  write_mesh(read_mesh(path("case")), path("case.vtu"));
  expect_alike("case", "case.vtu", "--field p", 1e-6f);
}

// What OpenFOAM makes of hexahedra: refined, dual, with a flow; and what it writes for VTK.
TEST_F(RenderedFile, OfACaseThatOpenFoamMade) {
  if (std::system("command -v blockMesh polyDualMesh icoFoam foamToVTK >/dev/null") != 0)
    GTEST_SKIP() << "SKIPPED FOR LACK OF OpenFOAM: apt-get install openfoam";
  const std::string flow = path("flow").string();
  const std::string make =
      std::string(PLUME_SOURCE_DIR) + "/tests/io/polyhedral_cavity.sh '" + flow +
      "' 10 >/dev/null && cd '" + flow +
      "' && WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam} foamToVTK "
      "-latestTime -no-boundary -no-point-data -name ../vtk >log.foamToVTK 2>&1";
  ASSERT_EQ(std::system(make.c_str()), 0);
  std::string vtu;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path("vtk")))
    if (entry.path().filename() == "internal.vtu")
      vtu = std::filesystem::relative(entry.path(), path("")).string();
  ASSERT_FALSE(vtu.empty());
  const Mesh mesh = read_mesh(path("flow"));
  const auto types = values(mesh.cells.types);
  EXPECT_GT(std::count(types.begin(), types.end(), 42.0), 200);
  for (const std::string what : {"p --cell-data constant", "U:magnitude --cell-data averaged"})
    expect_alike("flow", vtu, "--association cell --opacity-scale 3 --field " + what, 1e-4f);
}

}  // namespace
}  // namespace plume::test
