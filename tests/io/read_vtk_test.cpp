// VTK's own formats, written by VTK's writers or by hand.
#include <vtkAppendFilter.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkMatrix3x3.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLMultiBlockDataWriter.h>
#include <vtkXMLPUnstructuredGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "read_test_files.h"

namespace plume::test {
namespace {

using VtkFile = FileTest;

void add_fields(vtkDataSet& data) {
  vtkNew<vtkFloatArray> temperature;
  temperature->SetName("temperature");
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i)
    temperature->InsertNextValue(static_cast<float>(i));
  data.GetPointData()->SetScalars(temperature);
  vtkNew<vtkDoubleArray> velocity;
  velocity->SetName("velocity");
  velocity->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < data.GetNumberOfCells(); ++i)
    velocity->InsertNextTuple3(static_cast<double>(i), 0, -1);
  data.GetCellData()->AddArray(velocity);
}

// 4 x 3 x 2 points, shifted along x.
vtkSmartPointer<vtkStructuredGrid> structured(double shift = 0) {
  vtkNew<vtkStructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i) points->InsertNextPoint(i + shift, j, k);
  grid->SetDimensions(4, 3, 2);
  grid->SetPoints(points);
  add_fields(*grid);
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> unstructured() {
  vtkNew<vtkAppendFilter> append;
  append->AddInputData(structured());
  append->Update();
  return append->GetOutput();
}

template <class Writer>
std::filesystem::path written(vtkDataObject* data, const std::filesystem::path& file) {
  vtkNew<Writer> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(data);
  EXPECT_EQ(writer->Write(), 1);
  return file;
}

TEST_F(VtkFile, ReadsUnstructuredGridsInEveryEncoding) {
  for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended})
    for (const int compressor :
         {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4, vtkXMLWriter::LZMA})
      for (const int order : {vtkXMLWriter::BigEndian, vtkXMLWriter::LittleEndian}) {
        vtkNew<vtkXMLUnstructuredGridWriter> writer;
        writer->SetFileName(path("a.vtu").c_str());
        writer->SetInputData(unstructured());
        writer->SetDataMode(mode);
        writer->SetCompressorType(compressor);
        writer->SetByteOrder(order);
        ASSERT_EQ(writer->Write(), 1);
        const Mesh mesh = read_mesh(path("a.vtu"));
        ASSERT_EQ(mesh.point_count(), 24u);
        ASSERT_EQ(mesh.cell_count(), 6u);
        EXPECT_EQ(values(mesh.cells.types), std::vector<double>{12});
        EXPECT_TRUE(mesh.cells.offsets.empty());
        EXPECT_EQ(mesh.active_field, "temperature");
        EXPECT_EQ(range(*field(mesh, "temperature")), (std::array<double, 2>{0, 23}));
        EXPECT_EQ(field(mesh, "velocity")->association, Association::cell);
        EXPECT_EQ(range(*field(mesh, "velocity")), (std::array<double, 2>{-1, 5}));
      }
}

TEST_F(VtkFile, AStructuredGridStaysOne) {
  const Mesh mesh = read_mesh(written<vtkXMLStructuredGridWriter>(structured(), path("a.vts")));
  EXPECT_EQ(mesh.dimensions, (std::array<std::int64_t, 3>{4, 3, 2}));
  EXPECT_EQ(mesh.points.type(), Array::Type::float32);
  EXPECT_EQ(mesh.points.at<double>(3 * 23), 3);
  EXPECT_EQ(mesh.cell_count(), 6u);
  EXPECT_TRUE(mesh.cells.connectivity.empty());
}

TEST_F(VtkFile, ATurnedImagesPointsFollowItsOriginSpacingAndDirection) {
  vtkNew<vtkImageData> image;
  // Extents need not start at 0.
  image->SetExtent(2, 4, 0, 2, 1, 4);
  image->SetOrigin(10, 20, 30);
  image->SetSpacing(0.5, 1, 2);
  // Axes i, j, k along y, -x, z.
  image->SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1);
  add_fields(*image);
  const Mesh mesh = read_mesh(written<vtkXMLImageDataWriter>(image, path("a.vti")));
  EXPECT_FALSE(mesh.is_rectilinear());
  EXPECT_EQ(mesh.dimensions, (std::array<std::int64_t, 3>{3, 3, 4}));
  const auto points = values(mesh.points);
  EXPECT_EQ(std::vector<double>(points.begin(), points.begin() + 6),
            (std::vector<double>{10, 21, 32, 10, 21.5, 32}));
  EXPECT_EQ(std::vector<double>(points.end() - 3, points.end()), (std::vector<double>{8, 22, 38}));
}

TEST_F(VtkFile, SeveralPiecesAndBlocksBecomeOneMesh) {
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, structured());
  blocks->SetBlock(1, structured(3));
  blocks->SetBlock(2, unstructured());
  written<vtkXMLMultiBlockDataWriter>(blocks, path("a.vtm"));
  const Mesh apart = read_mesh(path("a.vtm"));
  EXPECT_EQ(apart.cell_count(), 18u);
  EXPECT_EQ(apart.point_count(), 72u);
  EXPECT_EQ(apart.cells.types.size(), 1u);
  EXPECT_EQ(apart.active_field, "temperature");
  EXPECT_EQ(range(*field(apart, "velocity")), (std::array<double, 2>{-1, 5}));

  // The second block shares six points with the first, and the third all of them.
  Read merged = read(path("a.vtm"), {.merge_points = true});
  EXPECT_EQ(merged.mesh.point_count(), 24u + 18u);
  EXPECT_TRUE(merged.was_told("field 'temperature' differs between blocks at 6 merged points"));
}

TEST_F(VtkFile, ReadsParallelUnstructuredFiles) {
  vtkNew<vtkXMLPUnstructuredGridWriter> writer;
  writer->SetFileName(path("a.pvtu").c_str());
  writer->SetInputData(unstructured());
  writer->SetNumberOfPieces(1);
  ASSERT_EQ(writer->Write(), 1);
  EXPECT_EQ(read_mesh(path("a.pvtu")).cell_count(), 6u);
  std::filesystem::remove(path("a_0.vtu"));
  EXPECT_NE(error_of(path("a.pvtu")).find("a.pvtu"), std::string::npos);
}

TEST_F(VtkFile, ChoosesATimeStepOfACollection) {
  written<vtkXMLStructuredGridWriter>(structured(), path("first.vts"));
  written<vtkXMLStructuredGridWriter>(structured(), path("left.vts"));
  written<vtkXMLStructuredGridWriter>(structured(3), path("right.vts"));
  // Later steps need not come later.
  const auto collection = write("a.pvd",
                                "<VTKFile type=\"Collection\"><Collection>"
                                "<DataSet timestep=\"2.5\" part=\"0\" file=\"left.vts\"/>"
                                "<DataSet timestep=\"0\" part=\"0\" file=\"first.vts\"/>"
                                "<DataSet timestep=\"2.5\" part=\"1\" file=\"right.vts\"/>"
                                "</Collection></VTKFile>");
  EXPECT_EQ(read_mesh(collection).cell_count(), 12u);
  const Mesh first = read_mesh(collection, {.time_step = 0});
  EXPECT_TRUE(first.is_grid());
  EXPECT_EQ(first.cell_count(), 6u);
  EXPECT_NE(error_of(collection, {.time_step = 2}).find("choose one from 0 to 1"),
            std::string::npos);
  std::filesystem::remove(path("right.vts"));
  EXPECT_NE(error_of(collection).find("right.vts: no such file"), std::string::npos);
}

// A tetrahedron, a triangle, a quadratic tetrahedron, a line and another tetrahedron.
vtkSmartPointer<vtkUnstructuredGrid> mixture() {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 10; ++i) points->InsertNextPoint(i % 3, i % 4, i % 5);
  grid->SetPoints(points);
  const std::vector<vtkIdType> tetrahedron{0, 1, 2, 3}, triangle{0, 1, 2},
      quadratic{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, line{0, 1}, last{4, 5, 6, 7};
  grid->InsertNextCell(10, 4, tetrahedron.data());
  grid->InsertNextCell(5, 3, triangle.data());
  grid->InsertNextCell(24, 10, quadratic.data());
  grid->InsertNextCell(3, 2, line.data());
  grid->InsertNextCell(10, 4, last.data());
  vtkNew<vtkIntArray> numbers;
  numbers->SetName("number");
  for (int i = 0; i < 5; ++i) numbers->InsertNextValue(i);
  grid->GetCellData()->AddArray(numbers);
  return grid;
}

TEST_F(VtkFile, DropsWhatIsNoVolumeAndKeepsFieldsInStep) {
  const Read result = read(written<vtkXMLUnstructuredGridWriter>(mixture(), path("mixture.vtu")));
  EXPECT_EQ(result.mesh.cell_count(), 3u);
  EXPECT_EQ(values(result.mesh.cells.types), std::vector<double>{10});
  EXPECT_EQ(values(result.mesh.cells.connectivity),
            (std::vector<double>{0, 1, 2, 3, 0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(values(field(result.mesh, "number")->values), (std::vector<double>{0, 2, 4}));
  EXPECT_TRUE(result.was_told("1 line, 1 triangle dropped: not volume cells"));
  EXPECT_TRUE(result.was_told("1 of the cells are of higher order"));
  EXPECT_EQ(result.notices.size(), 2u);
}

TEST_F(VtkFile, DropsGhostCellsAndCellsOfHiddenPoints) {
  auto grid = mixture();
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName("vtkGhostType");
  for (const int ghost : {0, 0, 0, 0, 1})
    ghosts->InsertNextValue(static_cast<unsigned char>(ghost));
  grid->GetCellData()->AddArray(ghosts);
  vtkNew<vtkUnsignedCharArray> hidden_points;
  hidden_points->SetName("vtkGhostType");
  // Point 9 is only a mid-edge point of the quadratic tetrahedron; 1 marks a duplicate, not hidden.
  for (const int ghost : {1, 0, 0, 0, 0, 0, 0, 0, 0, 2})
    hidden_points->InsertNextValue(static_cast<unsigned char>(ghost));
  grid->GetPointData()->AddArray(hidden_points);
  const Read result = read(written<vtkXMLUnstructuredGridWriter>(grid, path("ghosts.vtu")));
  EXPECT_EQ(values(field(result.mesh, "number")->values), std::vector<double>{0});
  EXPECT_TRUE(result.was_told("2 of the cells dropped: blanked"));
  EXPECT_EQ(result.mesh.fields.size(), 1u);
}

TEST_F(VtkFile, ABlankedCellOfAGridIsHidden) {
  auto grid = structured();
  grid->BlankCell(4);
  const Read result = read(written<vtkXMLStructuredGridWriter>(grid, path("blank.vts")));
  EXPECT_EQ(values(result.mesh.hidden_cells), (std::vector<double>{0, 0, 0, 0, 1, 0}));
  EXPECT_TRUE(result.was_told("1 of the cells hidden"));
}

TEST_F(VtkFile, ABlankedPointHidesItsCells) {
  auto grid = structured();
  // In the middle of the lower face, where four cells meet.
  grid->BlankPoint(5);
  const Read result = read(written<vtkXMLStructuredGridWriter>(grid, path("blank.vts")));
  EXPECT_EQ(values(result.mesh.hidden_cells), (std::vector<double>{1, 1, 0, 1, 1, 0}));
}

TEST_F(VtkFile, KeepsTypesThatAnArrayCanHoldAndConvertsOthers) {
  auto grid = unstructured();
  vtkNew<vtkIntArray> integers;
  integers->SetName("integers");
  vtkSmartPointer<vtkDataArray> shorts;
  shorts.TakeReference(vtkDataArray::CreateDataArray(VTK_SHORT));
  shorts->SetName("shorts");
  vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetName("bytes");
  vtkNew<vtkStringArray> strings;
  strings->SetName("strings");
  for (int i = 0; i < 6; ++i) {
    integers->InsertNextValue(-i);
    shorts->InsertNextTuple1(-2 * i);
    bytes->InsertNextValue(static_cast<unsigned char>(200 + i));
    strings->InsertNextValue("word");
  }
  grid->GetCellData()->AddArray(integers);
  grid->GetCellData()->AddArray(shorts);
  grid->GetCellData()->AddArray(bytes);
  grid->GetCellData()->AddArray(strings);
  const Read result = read(written<vtkXMLUnstructuredGridWriter>(grid, path("types.vtu")));
  EXPECT_EQ(field(result.mesh, "integers")->values.type(), Array::Type::int32);
  EXPECT_EQ(field(result.mesh, "shorts")->values.type(), Array::Type::float32);
  EXPECT_EQ(field(result.mesh, "bytes")->values.type(), Array::Type::uint8);
  EXPECT_EQ(range(*field(result.mesh, "shorts")), (std::array<double, 2>{-10, 0}));
  EXPECT_EQ(range(*field(result.mesh, "bytes")), (std::array<double, 2>{200, 205}));
  EXPECT_EQ(result.mesh.fields.size(), 5u);
}

TEST_F(VtkFile, GivesAPointAndACellFieldOfOneNameTwoNames) {
  auto grid = unstructured();
  vtkNew<vtkIntArray> cell_temperature;
  cell_temperature->SetName("temperature");
  for (int i = 0; i < 6; ++i) cell_temperature->InsertNextValue(i);
  grid->GetCellData()->AddArray(cell_temperature);
  const Read result = read(written<vtkXMLUnstructuredGridWriter>(grid, path("names.vtu")));
  EXPECT_EQ(field(result.mesh, "temperature")->association, Association::point);
  EXPECT_EQ(field(result.mesh, "temperature_cell")->association, Association::cell);
  EXPECT_TRUE(result.was_told("is called 'temperature_cell'"));
}

TEST_F(VtkFile, KeepsOnlyFieldsThatAllBlocksHave) {
  auto other = structured(10);
  other->GetPointData()->RemoveArray("temperature");
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, structured());
  blocks->SetBlock(1, other);
  const Read result = read(written<vtkXMLMultiBlockDataWriter>(blocks, path("partial.vtm")));
  ASSERT_EQ(result.mesh.fields.size(), 1u);
  EXPECT_EQ(result.mesh.fields[0].name, "velocity");
  EXPECT_EQ(result.mesh.active_field, "");
  EXPECT_TRUE(result.was_told("field 'temperature' dropped: only 1 of 2 blocks have it"));
}

TEST_F(VtkFile, ReadsThePublicLegacyFiles) {
  const auto prisms = dataset("formats/PentaHexa.vtk");
  PLUME_SKIP_WITHOUT(prisms);
  const Mesh mesh = read_mesh(prisms);
  EXPECT_EQ(mesh.point_count(), 401u);
  EXPECT_EQ(mesh.cell_count(), 210u);
  const auto types = values(mesh.cells.types);
  EXPECT_EQ(std::count(types.begin(), types.end(), 15) +
                std::count(types.begin(), types.end(), 16) +
                std::count(types.begin(), types.end(), 13),
            210);
  EXPECT_EQ(mesh.active_field, "scalar2");
  EXPECT_EQ(field(mesh, "scalar1")->association, Association::cell);

  const Mesh hexahedra = read_mesh(dataset("formats/hexa.vtk"));
  EXPECT_EQ(hexahedra.point_count(), 12167u);
  EXPECT_EQ(hexahedra.cell_count(), 10648u);
  EXPECT_EQ(values(hexahedra.cells.types), std::vector<double>{12});
  EXPECT_NEAR(range(*field(hexahedra, "scalars"))[1], 17.320507, 1e-6);

  const Mesh tetrahedra = read_mesh(dataset("formats/tetraMesh.vtk"));
  EXPECT_EQ(tetrahedra.cell_count(), 160u);
  EXPECT_EQ(values(tetrahedra.cells.types), std::vector<double>{10});
  EXPECT_EQ(field(tetrahedra, "scalars")->values.type(), Array::Type::int32);
}

TEST_F(VtkFile, ReadsAllArraysOfALegacyFile) {
  const Mesh mesh = read_mesh(
      write("arrays.vtk",
            "# vtk DataFile Version 3.0\narrays\nASCII\nDATASET UNSTRUCTURED_GRID\n"
            "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n"
            "POINT_DATA 4\nSCALARS a float 1\nLOOKUP_TABLE default\n1 2 3 4\n"
            "SCALARS b double 1\nLOOKUP_TABLE default\n5 6 7 8\n"
            "VECTORS v float\n1 0 0 0 1 0 0 0 1 1 1 1\n"
            "FIELD FieldData 1\nc 2 4 int\n1 2 3 4 5 6 7 8\n"));
  EXPECT_EQ(mesh.fields.size(), 4u);
  EXPECT_EQ(mesh.active_field, "a");
  EXPECT_EQ(range(*field(mesh, "b")), (std::array<double, 2>{5, 8}));
  EXPECT_EQ(field(mesh, "v")->components, 3);
  EXPECT_EQ(field(mesh, "c")->components, 2);
}

TEST_F(VtkFile, HearsErrorsOfAHostThatSwitchedVtksMessagesOff) {
  vtkSmartPointer<vtkOutputWindow> window = vtkOutputWindow::GetInstance();
  vtkObject::GlobalWarningDisplayOff();
  const auto broken = write("broken.vtu", "<VTKFile type=\"UnstructuredGrid\"><Piece></VTKFile>");
  EXPECT_NE(error_of(broken).find("Error parsing XML"), std::string::npos);
  EXPECT_EQ(vtkObject::GetGlobalWarningDisplay(), 0);
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_EQ(vtkOutputWindow::GetInstance(), window.Get());
}

TEST_F(VtkFile, BorrowsTheArraysOfAWholeFile) {
  // What VTK keeps for the mesh goes with it: a leak checker sees if not.
  Array points;
  {
    const Mesh mesh =
        read_mesh(written<vtkXMLUnstructuredGridWriter>(unstructured(), path("a.vtu")));
    points = mesh.points;
  }
  EXPECT_EQ(points.at<double>(3 * 23), 3);
}

}  // namespace
}  // namespace plume::test
