// The filter's picture is the library's; what it keeps; what it says of bad input.

#include "plume/vtk/image_filter.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPoints.h>
#include <vtkStructuredGrid.h>
#include <vtkTrivialProducer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataReader.h>

#include <cstdlib>
#include <sstream>

#include "plume/io/write_mesh.h"
#include "plume/tests/vtk/vtk_scenes.h"

namespace plume::test {
namespace {

constexpr int kWidth = 60, kHeight = 44;

RenderSettings settings() {
  RenderSettings result;
  result.width = kWidth;
  result.height = kHeight;
  return result;
}

vtkSmartPointer<vtkPlumeImageFilter> filter_of(vtkDataObject* data) {
  auto filter = vtkSmartPointer<vtkPlumeImageFilter>::New();
  filter->SetInputDataObject(data);
  filter->SetSize(kWidth, kHeight);
  filter->SetVolumeProperty(property_of(bump()));
  filter->SetActiveCamera(in_vtk(aside()));
  return filter;
}

// The greatest difference of a channel; VTK's first row is the lowest.
double difference(vtkImageData& output, const Image& image) {
  EXPECT_EQ(output.GetDimensions()[0], image.width);
  EXPECT_EQ(output.GetDimensions()[1], image.height);
  vtkDataArray* const rgba = output.GetPointData()->GetScalars();
  double greatest = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 4; ++c)
        greatest = std::max(
            greatest, std::abs(rgba->GetComponent((image.height - 1 - y) * image.width + x, c) -
                               static_cast<double>(image.pixel(x, y)[c])));
  return greatest;
}

// Rays differ by the rounding of VTK's matrices; 1e-3 is what is promised.
constexpr double kRounding = 2e-5;

TEST(VtkImageFilter, GivesTheLibrarysPictureOfAnyMesh) {
  for (const char* name :
       {"box-tetrahedra", "twisted", "box-mixed", "box-polyhedra", "box-rectilinear"}) {
    const Mesh mesh = generate(name, {8, 0.2, 3});
    const auto filter = filter_of(in_vtk(mesh));
    filter->Update();
    const Image image = picture_of(mesh, bump(), aside(), settings());
    EXPECT_LT(difference(*filter->GetOutput(), image), kRounding) << name;
    EXPECT_GT(image.pixel(kWidth / 2, kHeight / 2)[3], 0.5f) << name;
    EXPECT_EQ(filter->GetOutput()->GetScalarType(), VTK_FLOAT);
  }
}

TEST(VtkImageFilter, FollowsTheCamera) {
  const Mesh mesh = generate("box-tetrahedra", {6, 0.2, 3});
  Camera parallel = aside();
  parallel.parallel = true;
  Camera beside = aside();
  beside.window_center = {0.4, -0.3};
  Camera parallel_beside = parallel;
  parallel_beside.window_center = {-0.7, 0.2};
  for (const Camera& camera : {parallel, beside, parallel_beside}) {
    const auto filter = filter_of(in_vtk(mesh));
    filter->SetActiveCamera(in_vtk(camera));
    filter->Update();
    EXPECT_LT(difference(*filter->GetOutput(), picture_of(mesh, bump(), camera, settings())),
              kRounding);
  }
  // A horizontal angle, and a camera that moved after the first picture.
  const auto filter = filter_of(in_vtk(mesh));
  filter->Update();
  vtkCamera& eye = *filter->GetActiveCamera();
  eye.UseHorizontalViewAngleOn();
  eye.SetViewAngle(40);
  eye.Azimuth(15);
  filter->Update();
  Camera camera = aside();
  orbit(camera, 15, 0);
  camera.view_angle = 2 * std::atan(std::tan(20 * M_PI / 180) * kHeight / kWidth) * 180 / M_PI;
  EXPECT_LT(difference(*filter->GetOutput(), picture_of(mesh, bump(), camera, settings())),
            kRounding);
  EXPECT_EQ(filter->GetMeshesMade(), 1);
}

TEST(VtkImageFilter, MakesNoMoreAnewThanHasChanged) {
  const Mesh mesh = generate("box-tetrahedra", {6, 0.2, 3});
  const auto data = in_vtk(mesh);
  // A field that may be written to.
  vtkNew<vtkFloatArray> values;
  values->DeepCopy(data->GetPointData()->GetScalars());
  values->SetName("mine");
  data->GetPointData()->SetScalars(values);
  const auto filter = filter_of(data);
  const auto made = [&] {
    filter->Update();
    return std::array{filter->GetMeshesMade(), filter->GetFieldsPut(),
                      filter->GetTransferFunctionsMade()};
  };
  using Counts = std::array<int, 3>;
  EXPECT_EQ(made(), (Counts{1, 0, 1}));
  filter->GetActiveCamera()->Azimuth(10);
  EXPECT_EQ(made(), (Counts{1, 0, 1}));
  filter->GetVolumeProperty()->GetScalarOpacity()->AddPoint(5, 0.5);
  EXPECT_EQ(made(), (Counts{1, 0, 2}));
  for (vtkIdType i = 0; i < values->GetNumberOfValues(); ++i)
    values->SetValue(i, 6 - values->GetValue(i));
  values->Modified();
  EXPECT_EQ(made(), (Counts{1, 1, 2}));

  // What is kept is what would be made anew.
  const auto anew = filter_of(data);
  anew->SetVolumeProperty(filter->GetVolumeProperty());
  anew->SetActiveCamera(filter->GetActiveCamera());
  anew->Update();
  const auto* const one =
      static_cast<vtkFloatArray*>(filter->GetOutput()->GetPointData()->GetScalars());
  const auto* const other =
      static_cast<vtkFloatArray*>(anew->GetOutput()->GetPointData()->GetScalars());
  for (vtkIdType i = 0; i < one->GetNumberOfValues(); ++i)
    ASSERT_EQ(one->GetValue(i), other->GetValue(i));

  // The same points and cells in other arrays, as readers of time steps give them.
  vtkNew<vtkUnstructuredGrid> copy;
  copy->DeepCopy(data);
  filter->SetInputDataObject(copy);
  EXPECT_EQ(made(), (Counts{1, 2, 2}));
  // Points that were moved where they are.
  copy->GetPoints()->SetPoint(3, -0.5, 0.1, 0.2);
  copy->GetPoints()->Modified();
  EXPECT_EQ(made(), (Counts{2, 2, 2}));
  // Another array, on cells.
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "cell_radius");
  EXPECT_EQ(made(), (Counts{3, 2, 2}));
}

TEST(VtkImageFilter, TakesComponentsCellsAndBlocks) {
  const Mesh mesh = generate("blunt-body", {16, 0, 1});
  const Camera camera =
      named_view("iso", Scene(mesh).bounds(), static_cast<double>(kWidth) / kHeight);
  const auto data = in_vtk(mesh, "velocity");
  const TransferFunction function{{{-1, {0.1f, {1, 0, 0}}}, {3, {1, {0, 0, 1}}}}};
  const auto filter = filter_of(data);
  filter->SetVolumeProperty(property_of(function));
  filter->SetActiveCamera(in_vtk(camera));
  for (const auto& [component, name] :
       {std::pair{1, "velocity:1"}, std::pair{-1, "velocity:magnitude"}}) {
    filter->SetComponent(component);
    filter->Update();
    EXPECT_LT(difference(*filter->GetOutput(),
                         picture_of(mesh, function, camera, settings(), {name, {}})),
              kRounding);
  }
  EXPECT_EQ(filter->GetMeshesMade(), 1);

  const Mesh box = generate("box-hexahedra", {6, 0.2, 3});
  vtkNew<vtkMultiBlockDataSet> blocks;
  const auto grid = in_vtk(box);
  blocks->SetBlock(0, grid);
  vtkNew<vtkStructuredGrid> moved;
  moved->DeepCopy(grid);
  for (vtkIdType i = 0; i < moved->GetNumberOfPoints(); ++i) {
    double p[3];
    moved->GetPoint(i, p);
    moved->GetPoints()->SetPoint(i, p[0] + 1.5, p[1], p[2]);
  }
  blocks->SetBlock(1, moved);
  const auto of_blocks = filter_of(blocks);
  of_blocks->Update();
  const auto of_one = filter_of(grid);
  of_one->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "linear");
  of_one->Update();
  const auto opaque = [](vtkPlumeImageFilter& made) {
    int count = 0;
    for (vtkIdType i = 0; i < kWidth * kHeight; ++i)
      count += made.GetOutput()->GetPointData()->GetScalars()->GetComponent(i, 3) > 0.1;
    return count;
  };
  EXPECT_GT(opaque(*of_blocks), opaque(*of_one) + 50);
}

TEST(VtkImageFilter, GivesDepthAndBytes) {
  const Mesh mesh = generate("box-tetrahedra", {6, 0.2, 3});
  const auto filter = filter_of(in_vtk(mesh));
  filter->ComputeDepthOn();
  filter->SetOutputScalarTypeToUnsignedChar();
  filter->Update();
  RenderSettings with_depth = settings();
  with_depth.channels = {"depth"};
  const Image image = picture_of(mesh, bump(), aside(), with_depth);
  vtkPointData& given = *filter->GetOutput()->GetPointData();
  auto* const bytes = vtkUnsignedCharArray::SafeDownCast(given.GetScalars());
  auto* const depth = vtkFloatArray::SafeDownCast(given.GetArray("depth"));
  ASSERT_TRUE(bytes && depth);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const vtkIdType at = (kHeight - 1 - y) * kWidth + x;
      const float* const rgba = image.pixel(x, y);
      const float expected =
          image.channel("depth")->values[static_cast<std::size_t>(y * kWidth + x)];
      if (std::isfinite(expected)) {
        ASSERT_NEAR(depth->GetValue(at), expected, 1e-5);
      } else {
        ASSERT_EQ(depth->GetValue(at), expected);
      }
      ASSERT_NEAR(bytes->GetTypedComponent(at, 3), 255.0f * rgba[3], 0.51f);
      if (rgba[3] > 0.01f) {
        ASSERT_NEAR(bytes->GetTypedComponent(at, 1), 255 * std::min(1.0f, rgba[1] / rgba[3]), 0.6f);
      }
    }
}

TEST(VtkImageFilter, ChoosesColoursAndACameraWhereThereAreNone) {
  const Mesh mesh = generate("box-tetrahedra", {6, 0.2, 3});
  vtkNew<vtkPlumeImageFilter> filter;
  filter->SetInputDataObject(in_vtk(mesh));
  filter->SetSize(32, 32);
  filter->Update();
  vtkDataArray* const rgba = filter->GetOutput()->GetPointData()->GetScalars();
  EXPECT_GT(rgba->GetComponent(16 * 32 + 16, 3), 0.2);
  EXPECT_EQ(rgba->GetComponent(0, 3), 0);
  EXPECT_EQ(filter->GetTransferFunctionsMade(), 1);
}

// What is wrong is said, the update fails, and nothing is thrown or kept.
void expect_refused(vtkPlumeImageFilter& filter, const std::string& words) {
  const auto heard = Heard::from(filter);
  const auto of_pipeline = Heard::from(*filter.GetExecutive());
  filter.Update();
  EXPECT_NE(heard->errors.find(words), std::string::npos) << words << "; heard: " << heard->errors;
  EXPECT_EQ(filter.GetOutput()->GetNumberOfPoints(), 0);
}

TEST(VtkImageFilter, SaysWhatIsWrong) {
  const Mesh mesh = generate("blunt-body", {12, 0, 1});
  const auto data = in_vtk(mesh, "velocity");
  expect_refused(*filter_of(data), "'velocity' has 3 components; say which");
  auto filter = filter_of(data);
  filter->SetComponent(7);
  expect_refused(*filter, "velocity");
  filter = filter_of(data);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "enthalpy");
  {
    // VTK itself complains as well, of the array.
    expect_refused(*filter,
                   "no such array of numbers to show; there are density (point), pressure");
  }
  vtkNew<vtkUnstructuredGrid> nothing;
  expect_refused(*filter_of(nothing), "no cells");

  vtkNew<vtkUnstructuredGrid> surface;
  vtkNew<vtkPoints> corners;
  for (int i = 0; i < 3; ++i) corners->InsertNextPoint(i == 1, i == 2, 0);
  surface->SetPoints(corners);
  const vtkIdType triangle[3] = {0, 1, 2};
  surface->InsertNextCell(VTK_TRIANGLE, 3, triangle);
  vtkNew<vtkFloatArray> values;
  values->SetName("linear");
  for (int i = 0; i < 3; ++i) values->InsertNextValue(1.0f);
  surface->GetPointData()->SetScalars(values);
  expect_refused(*filter_of(surface), "no volume cells, only 1 triangle");
  // Ids out of range, and an array that is too short.
  const vtkIdType beyond[4] = {0, 1, 2, 99};
  surface->InsertNextCell(VTK_TETRA, 4, beyond);
  expect_refused(*filter_of(surface), "uses point 99 of 3");

  filter = filter_of(data);
  filter->SetComponentToMagnitude();
  filter->SetSize(0, 10);
  expect_refused(*filter, "a picture of 0 x 10 pixels");
  filter->SetSize(10, 10);
  filter->GetActiveCamera()->SetViewShear(0.5, 0, 1);
  expect_refused(*filter, "shear");
  filter->SetActiveCamera(in_vtk(aside()));
  filter->GetVolumeProperty()->GetScalarOpacity()->AddPoint(1, -0.5);
  expect_refused(*filter, "extinction");
  filter->SetVolumeProperty(nullptr);
  filter->SetTolerance(3);
  expect_refused(*filter, "3");
  filter->SetTolerance(1e-3);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 100);
}

// examples/vtk_pipeline.cpp, as a user runs it.
TEST(VtkImageFilter, MakesThePictureOfTheExample) {
  const Mesh mesh = generate("box-tetrahedra", {10, 0.2, 3});
  const std::string name = ::testing::TempDir() + "vtk_pipeline_test";
  write_mesh(mesh, name + ".vtu");
  const std::string command = PLUME_VTK_PIPELINE " " + name + ".vtu radius " + name + ".vti";
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName((name + ".vti").c_str());
  reader->Update();

  const Scene scene(mesh, {{"radius", {}}});
  const float low = scene.field().low, high = scene.field().high;
  const float clear = static_cast<float>(0.9 / (scene.bounds().diagonal() / 20));
  const TransferFunction function{{{low, {clear, {0.23f, 0.30f, 0.75f}}},
                                   {(low + high) / 2, {clear / 2, {0.87f, 0.87f, 0.87f}}},
                                   {high, {0, {0.71f, 0.02f, 0.15f}}}}};
  RenderSettings size;
  size.width = 320;
  size.height = 240;
  const Image image =
      picture_of(mesh, function, fitted_camera(scene.bounds(), {0, 0, -1}, {0, 1, 0}, 4.0 / 3),
                 size, {"radius", {}});
  EXPECT_LT(difference(*reader->GetOutput(), image), kRounding);
  EXPECT_GT(image.pixel(160, 120)[3], 0.5f);
}

TEST(VtkImageFilter, IsAVtkObject) {
  vtkNew<vtkPlumeImageFilter> filter;
  EXPECT_STREQ(filter->GetClassName(), "vtkPlumeImageFilter");
  EXPECT_TRUE(filter->IsA("vtkImageAlgorithm"));
  std::ostringstream printed;
  filter->Print(printed);
  EXPECT_NE(printed.str().find("Size: 1024 x 768"), std::string::npos);
}

}  // namespace
}  // namespace plume::test
