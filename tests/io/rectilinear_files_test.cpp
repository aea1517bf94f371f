// Regular and rectilinear grids in files: read as their axes, written and read back.
#include <vtkCellData.h>
#include <vtkDataSetWriter.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRectilinearGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLMultiBlockDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>

#include "plume/io/write_mesh.h"
#include "plume/mesh/error.h"
#include "plume/mesh/validate.h"
#include "read_test_files.h"

namespace plume::test {
namespace {

using RectilinearFile = FileTest;
using Axes = std::array<std::vector<double>, 3>;

Axes axes_of(const Mesh& mesh) {
  EXPECT_TRUE(mesh.is_rectilinear());
  EXPECT_TRUE(mesh.points.empty());
  for (std::size_t a = 0; a < 3; ++a)
    EXPECT_EQ(static_cast<std::size_t>(mesh.dimensions[a]), mesh.axes[a].size());
  EXPECT_NO_THROW(check_structure(mesh));
  return {values(mesh.axes[0]), values(mesh.axes[1]), values(mesh.axes[2])};
}

// Points and cells are numbered, so that their order shows.
void number(vtkDataSet& data) {
  vtkNew<vtkFloatArray> points;
  points->SetName("point");
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i)
    points->InsertNextValue(static_cast<float>(i));
  data.GetPointData()->SetScalars(points);
  vtkNew<vtkIntArray> cells;
  cells->SetName("cell");
  for (vtkIdType i = 0; i < data.GetNumberOfCells(); ++i)
    cells->InsertNextValue(static_cast<int>(i));
  data.GetCellData()->AddArray(cells);
}

vtkSmartPointer<vtkImageData> image() {
  vtkNew<vtkImageData> image;
  // Extents need not start at 0.
  image->SetExtent(2, 4, 0, 3, 1, 5);
  image->SetOrigin(10, 20, 30);
  image->SetSpacing(0.5, 1, 2);
  number(*image);
  return image;
}
const Axes kImage{{{11, 11.5, 12}, {20, 21, 22, 23}, {32, 34, 36, 38, 40}}};

template <class Values>
vtkSmartPointer<vtkRectilinearGrid> rectilinear(const Axes& axes) {
  vtkNew<vtkRectilinearGrid> grid;
  grid->SetDimensions(static_cast<int>(axes[0].size()), static_cast<int>(axes[1].size()),
                      static_cast<int>(axes[2].size()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    vtkNew<Values> along;
    for (const double x : axes[axis])
      along->InsertNextValue(static_cast<typename Values::ValueType>(x));
    if (axis == 0) grid->SetXCoordinates(along);
    if (axis == 1) grid->SetYCoordinates(along);
    if (axis == 2) grid->SetZCoordinates(along);
  }
  number(*grid);
  return grid;
}
// The second one descends.
const Axes kUneven{{{1, 4, 4.5}, {3, 2, 0, -8}, {-1, 5, 6, 7, 9}}};

template <class Writer>
std::filesystem::path written(vtkDataObject* data, const std::filesystem::path& file) {
  vtkNew<Writer> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(data);
  EXPECT_EQ(writer->Write(), 1);
  return file;
}

void expect_numbered(const Mesh& mesh) {
  const auto points = values(field(mesh, "point")->values);
  ASSERT_EQ(points.size(), mesh.point_count());
  for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(points[i], static_cast<double>(i));
  const auto cells = values(field(mesh, "cell")->values);
  ASSERT_EQ(cells.size(), mesh.cell_count());
  for (std::size_t i = 0; i < cells.size(); ++i) ASSERT_EQ(cells[i], static_cast<double>(i));
}

TEST_F(RectilinearFile, AnImageIsItsAxes) {
  for (const bool legacy : {false, true}) {
    const Mesh mesh = read_mesh(legacy ? written<vtkDataSetWriter>(image(), path("a.vtk"))
                                       : written<vtkXMLImageDataWriter>(image(), path("a.vti")));
    EXPECT_EQ(axes_of(mesh), kImage);
    EXPECT_EQ(mesh.active_field, "point");
    expect_numbered(mesh);
  }
}

TEST_F(RectilinearFile, AnImagesAxesMayDescend) {
  auto down = image();
  down->SetSpacing(0.5, -1, 2);
  const Mesh mesh = read_mesh(written<vtkXMLImageDataWriter>(down, path("spacing.vti")));
  EXPECT_EQ(axes_of(mesh)[1], (std::vector<double>{20, 19, 18, 17}));
  auto mirrored = image();
  mirrored->SetDirectionMatrix(-1, 0, 0, 0, 1, 0, 0, 0, -1);
  const Mesh other = read_mesh(written<vtkXMLImageDataWriter>(mirrored, path("mirrored.vti")));
  EXPECT_EQ(axes_of(other), (Axes{{{9, 8.5, 8}, {20, 21, 22, 23}, {28, 26, 24, 22, 20}}}));
  expect_numbered(other);
}

TEST_F(RectilinearFile, ARectilinearGridIsItsAxes) {
  for (const bool legacy : {false, true}) {
    const auto grid = rectilinear<vtkDoubleArray>(kUneven);
    const Mesh mesh = read_mesh(legacy ? written<vtkDataSetWriter>(grid, path("a.vtk"))
                                       : written<vtkXMLRectilinearGridWriter>(grid, path("a.vtr")));
    EXPECT_EQ(axes_of(mesh), kUneven);
    EXPECT_EQ(mesh.axes[0].type(), Array::Type::float64);
    expect_numbered(mesh);
  }
  const Mesh single = read_mesh(
      written<vtkXMLRectilinearGridWriter>(rectilinear<vtkFloatArray>(kUneven), path("b.vtr")));
  EXPECT_EQ(axes_of(single), kUneven);
  EXPECT_EQ(single.axes[0].type(), Array::Type::float32);
  const Mesh whole = read_mesh(
      written<vtkXMLRectilinearGridWriter>(rectilinear<vtkIntArray>(kImage), path("c.vtr")));
  EXPECT_EQ(whole.axes[2].type(), Array::Type::float32);
  EXPECT_EQ(values(whole.axes[2]), kImage[2]);
}

// The part of a numbered data set of 3 x 4 x 5 points whose extent along z is given, numbered as in
// the whole.
template <class Data>
void number_part(Data& part, int from, int to) {
  vtkNew<vtkFloatArray> points;
  points->SetName("point");
  for (int i = 12 * from; i < 12 * (to + 1); ++i) points->InsertNextValue(static_cast<float>(i));
  part.GetPointData()->SetScalars(points);
  vtkNew<vtkIntArray> cells;
  cells->SetName("cell");
  for (int i = 6 * from; i < 6 * to; ++i) cells->InsertNextValue(i);
  part.GetCellData()->AddArray(cells);
}

std::string parallel_file(const std::string& kind, const std::string& attributes,
                          const std::string& more, const std::string& extension) {
  return "<VTKFile type=\"P" + kind + "\" version=\"0.1\" byte_order=\"LittleEndian\"><P" + kind +
         " WholeExtent=\"0 2 0 3 0 4\" GhostLevel=\"0\"" + attributes + ">" +
         "<PPointData Scalars=\"point\"><PDataArray type=\"Float32\" "
         "Name=\"point\"/></PPointData>" +
         "<PCellData><PDataArray type=\"Int32\" Name=\"cell\"/></PCellData>" + more +
         "<Piece Extent=\"0 2 0 3 0 1\" Source=\"low" + extension + "\"/>" +
         "<Piece Extent=\"0 2 0 3 1 4\" Source=\"high" + extension + "\"/></P" + kind +
         "></VTKFile>\n";
}

TEST_F(RectilinearFile, PiecesOfAnImageAreOneGrid) {
  for (const bool upper : {false, true}) {
    vtkNew<vtkImageData> part;
    part->SetOrigin(10, 20, 30);
    part->SetSpacing(0.5, 1, 2);
    part->SetExtent(0, 2, 0, 3, upper ? 1 : 0, upper ? 4 : 1);
    number_part(*part, upper ? 1 : 0, upper ? 4 : 1);
    written<vtkXMLImageDataWriter>(part, path(upper ? "high.vti" : "low.vti"));
  }
  const auto whole = write(
      "a.pvti", parallel_file("ImageData", " Origin=\"10 20 30\" Spacing=\"0.5 1 2\"", "", ".vti"));
  const Mesh mesh = read_mesh(whole);
  EXPECT_EQ(axes_of(mesh), (Axes{{{10, 10.5, 11}, {20, 21, 22, 23}, {30, 32, 34, 36, 38}}}));
  expect_numbered(mesh);
  std::filesystem::remove(path("high.vti"));
  EXPECT_NE(error_of(whole).find("a.pvti"), std::string::npos);
}

TEST_F(RectilinearFile, PiecesOfARectilinearGridAreOne) {
  for (const bool upper : {false, true}) {
    Axes axes = kUneven;
    const auto from = axes[2].begin();
    axes[2] =
        upper ? std::vector<double>(from + 1, axes[2].end()) : std::vector<double>(from, from + 2);
    const auto part = rectilinear<vtkDoubleArray>(axes);
    part->SetExtent(0, 2, 0, 3, upper ? 1 : 0, upper ? 4 : 1);
    part->GetPointData()->Initialize();
    part->GetCellData()->Initialize();
    number_part(*part, upper ? 1 : 0, upper ? 4 : 1);
    written<vtkXMLRectilinearGridWriter>(part, path(upper ? "high.vtr" : "low.vtr"));
  }
  const std::string axis = "<PDataArray type=\"Float64\"/>";
  const auto whole = write(
      "a.pvtr", parallel_file("RectilinearGrid", "",
                              "<PCoordinates>" + axis + axis + axis + "</PCoordinates>", ".vtr"));
  const Mesh mesh = read_mesh(whole);
  EXPECT_EQ(axes_of(mesh), kUneven);
  expect_numbered(mesh);
  std::filesystem::remove(path("low.vtr"));
  EXPECT_NE(error_of(whole).find("a.pvtr"), std::string::npos);
}

TEST_F(RectilinearFile, BlankedCellsAreHidden) {
  const auto blank = [](vtkDataSet& data) {
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName("vtkGhostType");
    for (vtkIdType i = 0; i < data.GetNumberOfCells(); ++i)
      ghosts->InsertNextValue(i == 4   ? vtkDataSetAttributes::HIDDENCELL
                              : i == 7 ? vtkDataSetAttributes::DUPLICATECELL
                                       : 0);
    data.GetCellData()->AddArray(ghosts);
  };
  const auto picture = image();
  blank(*picture);
  const auto grid = rectilinear<vtkDoubleArray>(kUneven);
  blank(*grid);
  std::vector<double> expected(24, 0);
  expected[4] = expected[7] = 1;
  for (const auto& file : {written<vtkXMLImageDataWriter>(picture, path("a.vti")),
                           written<vtkXMLRectilinearGridWriter>(grid, path("a.vtr")),
                           written<vtkDataSetWriter>(grid, path("a.vtk"))}) {
    SCOPED_TRACE(file.string());
    const Read result = read(file);
    EXPECT_TRUE(result.mesh.is_rectilinear());
    EXPECT_EQ(values(result.mesh.hidden_cells), expected);
    EXPECT_TRUE(result.was_told("2 of the cells hidden"));
    EXPECT_EQ(result.mesh.fields.size(), 2u);
  }
}

TEST_F(RectilinearFile, ABlankedPointHidesItsCells) {
  const auto picture = image();
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName("vtkGhostType");
  // The corner of the first cell that it shares with three others of its layer.
  for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); ++i)
    ghosts->InsertNextValue(i == 4 ? vtkDataSetAttributes::HIDDENPOINT : 0);
  picture->GetPointData()->AddArray(ghosts);
  const Mesh mesh = read_mesh(written<vtkXMLImageDataWriter>(picture, path("a.vti")));
  const auto hidden = values(mesh.hidden_cells);
  EXPECT_EQ(std::vector<double>(hidden.begin(), hidden.begin() + 6),
            (std::vector<double>{1, 1, 1, 1, 0, 0}));
  EXPECT_EQ(std::count(hidden.begin(), hidden.end(), 1), 4);
}

TEST_F(RectilinearFile, SeveralImagesBecomeExplicitCells) {
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, image());
  blocks->SetBlock(1, rectilinear<vtkDoubleArray>(kUneven));
  const Mesh mesh = read_mesh(written<vtkXMLMultiBlockDataWriter>(blocks, path("a.vtm")));
  EXPECT_FALSE(mesh.is_grid());
  EXPECT_EQ(mesh.cell_count(), 48u);
  ASSERT_EQ(mesh.point_count(), 120u);
  const auto points = values(mesh.points);
  EXPECT_EQ(std::vector<double>(points.begin(), points.begin() + 6),
            (std::vector<double>{11, 20, 32, 11.5, 20, 32}));
  EXPECT_EQ(std::vector<double>(points.end() - 3, points.end()), (std::vector<double>{4.5, -8, 9}));
  EXPECT_NO_THROW(check_structure(mesh));
}

TEST_F(RectilinearFile, SaysWhichCoordinateIsOutOfOrder) {
  // What is read is what the file holds; whoever makes it walkable is told.
  const Mesh mesh = read_mesh(written<vtkXMLRectilinearGridWriter>(
      rectilinear<vtkDoubleArray>({{{0, 1}, {0, 2, 1, 3}, {0, 1}}}), path("a.vtr")));
  try {
    check_structure(mesh);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("the y coordinate 2 is 1 after 2"), std::string::npos);
  }
  EXPECT_NE(error_of(written<vtkXMLRectilinearGridWriter>(
                         rectilinear<vtkDoubleArray>({{{0, 1, 2}, {0}, {0, 1}}}), path("f.vtr")))
                .find("no volume cells, only 2 quadrilaterals"),
            std::string::npos);
}

Mesh to_write(bool regular) {
  Mesh mesh;
  mesh.dimensions = {3, 4, 5};
  mesh.axes[0] = regular ? Array::own(std::vector<float>{0.1f, 0.2f, 0.3f})
                         : Array::own(std::vector<float>{0.1f, 0.2f, 0.4f});
  mesh.axes[1] = Array::own(std::vector<double>{1e7 + 3, 1e7 + 2, 1e7 + 1, 1e7});
  std::vector<double> thirds;
  for (int i = 0; i < 5; ++i) thirds.push_back(1e-9 * i / 3);
  mesh.axes[2] = Array::own(std::move(thirds));
  std::vector<float> point(60);
  std::vector<std::int32_t> cell(24);
  for (std::size_t i = 0; i < point.size(); ++i) point[i] = static_cast<float>(i);
  for (std::size_t i = 0; i < cell.size(); ++i) cell[i] = static_cast<std::int32_t>(i);
  std::vector<std::uint8_t> hidden(24, 0);
  hidden[3] = hidden[20] = 1;
  mesh.hidden_cells = Array::own(std::move(hidden));
  mesh.fields = {{"point", Association::point, 1, Array::own(std::move(point))},
                 {"cell", Association::cell, 1, Array::own(std::move(cell))}};
  mesh.active_field = "point";
  return mesh;
}

TEST_F(RectilinearFile, ComesBackAsItWasWritten) {
  const Mesh mesh = to_write(false);
  for (const std::string extension : {".vtr", ".vtk"}) {
    SCOPED_TRACE(extension);
    write_mesh(mesh, path("a" + extension));
    const Mesh back = read_mesh(path("a" + extension));
    EXPECT_EQ(axes_of(back), axes_of(mesh));
    EXPECT_EQ(back.axes[0].type(), Array::Type::float32);
    EXPECT_EQ(back.axes[1].type(), Array::Type::float64);
    EXPECT_EQ(values(back.hidden_cells), values(mesh.hidden_cells));
    EXPECT_EQ(back.active_field, "point");
    expect_numbered(back);
  }
}

TEST_F(RectilinearFile, ComesBackFromItsEndsIfItIsRegular) {
  const Mesh mesh = to_write(true);
  write_mesh(mesh, path("a.vti"));
  const Mesh back = read_mesh(path("a.vti"));
  const Axes got = axes_of(back), wanted = axes_of(mesh);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t i = 0; i < wanted[a].size(); ++i)
      EXPECT_NEAR(got[a][i], wanted[a][i], (a == 0 ? 3e-8 : 1e-15 * std::abs(wanted[a].back())));
  EXPECT_EQ(got[1], wanted[1]);
  EXPECT_EQ(values(back.hidden_cells), values(mesh.hidden_cells));
  expect_numbered(back);
}

TEST_F(RectilinearFile, PointsAreWrittenOutWhereTheFileNeedsThem) {
  const Mesh mesh = to_write(false);
  write_mesh(mesh, path("a.vts"));
  const Mesh grid = read_mesh(path("a.vts"));
  EXPECT_FALSE(grid.is_rectilinear());
  EXPECT_EQ(grid.dimensions, mesh.dimensions);
  EXPECT_EQ(values(grid.hidden_cells), values(mesh.hidden_cells));
  const auto points = values(grid.points);
  EXPECT_EQ(std::vector<double>(points.end() - 3, points.end()),
            (std::vector<double>{0.4f, 1e7, 1e-9 * 4 / 3}));
  expect_numbered(grid);
  write_mesh(mesh, path("a.vtu"));
  const Mesh cells = read_mesh(path("a.vtu"));
  EXPECT_EQ(cells.cell_count(), 22u);
  EXPECT_EQ(values(cells.points), points);
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

TEST_F(RectilinearFile, IsRefusedWhereItIsNone) {
  EXPECT_NE(write_error(to_write(false), path("a.vti"))
                .find("a.vti: .vti holds a regular grid, and the x coordinates are not equidistant "
                      "at 1; write .vtr"),
            std::string::npos);
  write_mesh(to_write(true), path("grid.vts"));
  EXPECT_NE(write_error(read_mesh(path("grid.vts")), path("a.vtr"))
                .find("the mesh is a curvilinear one; write .vts"),
            std::string::npos);
  write_mesh(to_write(true), path("cells.vtu"));
  EXPECT_NE(write_error(read_mesh(path("cells.vtu")), path("a.vti"))
                .find("the mesh has explicit cells; write .vtu"),
            std::string::npos);
  Mesh bad = to_write(true);
  bad.dimensions[1] = 9;
  EXPECT_NE(write_error(bad, path("a.vti")).find("a.vti: a grid of 3 x 9 x 5 points has 4"),
            std::string::npos);
}

TEST_F(RectilinearFile, IsTruncated) {
  for (const std::string extension : {".vtr", ".vti"}) {
    write_mesh(to_write(true), path("whole" + extension));
    const std::string whole = contents_of(path("whole" + extension));
    for (std::size_t length = 1; length + 1 < whole.size(); length += 13) {
      SCOPED_TRACE(extension + " cut to " + std::to_string(length));
      const auto file = write("cut" + extension, whole.substr(0, length));
      EXPECT_NE(error_of(file).find(file.string()), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace plume::test
