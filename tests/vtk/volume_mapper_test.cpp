// The mapper in a window: needs a display (tests/CMakeLists.txt gives it one).

#include "plume/vtk/volume_mapper.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkMatrix4x4.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkStructuredGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridLinearRayIntegrator.h>
#include <vtkUnstructuredGridVolumeRayCastMapper.h>
#include <vtkVolume.h>

#include <array>

#include "plume/tests/vtk/vtk_scenes.h"

namespace plume::test {
namespace {

constexpr int kWidth = 150, kHeight = 110;

RenderSettings settings() {
  RenderSettings result;
  result.width = kWidth;
  result.height = kHeight;
  return result;
}

// A window with a volume in it, as a VTK program makes them.
struct Shown {
  explicit Shown(vtkDataSet* data, vtkUnstructuredGridVolumeMapper* volume_mapper = nullptr) {
    if (volume_mapper != nullptr)
      volume_mapper->SetInputData(data);
    else
      mapper->SetInputData(data);
    volume->SetMapper(volume_mapper != nullptr ? volume_mapper : mapper);
    volume->SetProperty(property_of(bump()));
    renderer->AddVolume(volume);
    renderer->SetActiveCamera(in_vtk(aside()));
    renderer->ResetCameraClippingRange();
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(kWidth, kHeight);
    window->AddRenderer(renderer);
  }

  // What is in the window, as 0 to 1, the first row at the top.
  std::vector<std::array<float, 3>> pixels() {
    window->Render();
    vtkNew<vtkUnsignedCharArray> bytes;
    const int width = window->GetSize()[0], height = window->GetSize()[1];
    window->GetPixelData(0, 0, width - 1, height - 1, 0, bytes);
    std::vector<std::array<float, 3>> all;
    for (int y = height - 1; y >= 0; --y)
      for (int x = 0; x < width; ++x) {
        const vtkIdType at = y * width + x;
        all.push_back({});
        for (int c = 0; c < 3; ++c)
          all.back()[static_cast<std::size_t>(c)] = bytes->GetTypedComponent(at, c) / 255.0f;
      }
    return all;
  }

  vtkNew<vtkPlumeVolumeMapper> mapper;
  vtkNew<vtkVolume> volume;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
};

std::array<float, 3> over(const float* rgba, const std::array<double, 3>& background) {
  std::array<float, 3> result;
  for (std::size_t c = 0; c < 3; ++c)
    result[c] = rgba[c] + (1 - rgba[3]) * static_cast<float>(background[c]);
  return result;
}

// How many pixels differ by more than `tolerance` from the picture over a background.
int unlike(const std::vector<std::array<float, 3>>& pixels, const Image& image, double tolerance,
           const std::array<double, 3>& background = {0, 0, 0}) {
  int count = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto expected = over(image.pixel(x, y), background);
      const auto& shown = pixels[static_cast<std::size_t>(y * kWidth + x)];
      bool alike = true;
      for (std::size_t c = 0; c < 3; ++c)
        alike = alike && std::abs(shown[c] - std::min(expected[c], 1.0f)) <= tolerance;
      if (!alike) ++count;
    }
  return count;
}

// A frame buffer has steps of 1/255: half of one is lost where a pixel is written. Drivers may
// blend in bytes (Mesa does), which loses another half each of colour and transparency.
constexpr double kByte = 1.01 / 255, kBlended = 1.51 / 255;

TEST(VtkVolumeMapper, ShowsTheLibrarysPicture) {
  for (const char* name : {"box-tetrahedra", "twisted", "box-rectilinear"}) {
    const Mesh mesh = generate(name, {8, 0.2, 3});
    Shown shown(in_vtk(mesh));
    const auto heard = Heard::from(*shown.mapper.Get());
    const Image image = picture_of(mesh, bump(), aside(), settings());
    EXPECT_EQ(unlike(shown.pixels(), image, kByte), 0) << name << heard->errors;
    shown.renderer->SetBackground(0.2, 0.4, 0.8);
    EXPECT_EQ(unlike(shown.pixels(), image, kBlended, {0.2, 0.4, 0.8}), 0) << name;
    EXPECT_GT(image.pixel(kWidth / 2, kHeight / 2)[3], 0.5f) << name;
    EXPECT_EQ(heard->errors + heard->warnings, "");
    EXPECT_EQ(shown.mapper->GetMeshesMade(), 1);
  }
}

TEST(VtkVolumeMapper, FollowsParallelCamerasViewportsAndTiles) {
  const Mesh mesh = generate("box-tetrahedra", {6, 0.2, 3});
  Camera parallel = aside();
  parallel.parallel = true;
  Shown shown(in_vtk(mesh));
  shown.renderer->SetActiveCamera(in_vtk(parallel));
  shown.renderer->ResetCameraClippingRange();
  EXPECT_EQ(unlike(shown.pixels(), picture_of(mesh, bump(), parallel, settings()), kByte), 0);

  // A third of another window: renderers clear their own part alone.
  Shown in_part(in_vtk(mesh));
  in_part.renderer->SetActiveCamera(in_vtk(parallel));
  in_part.renderer->ResetCameraClippingRange();
  in_part.renderer->SetViewport(1.0 / 3, 0.5, 2.0 / 3, 1);
  RenderSettings small = settings();
  small.width = kWidth / 3;
  small.height = kHeight / 2;
  const Image part = picture_of(mesh, bump(), parallel, small);
  const auto pixels = in_part.pixels();
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool inside = x >= kWidth / 3 && x < 2 * kWidth / 3 && y < kHeight / 2;
      const auto& here = pixels[static_cast<std::size_t>(y * kWidth + x)];
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_NEAR(here[c], inside ? std::min(1.0f, part.pixel(x - kWidth / 3, y)[c]) : 0.0f,
                    kByte);
    }

  // A tile: the upper right quarter of a picture twice as large, as large screenshots are made.
  Camera quarter = aside();
  quarter.view_angle =
      2 * std::atan(std::tan(quarter.view_angle / 2 * M_PI / 180) / 2) * 180 / M_PI;
  quarter.window_center = {1, 1};
  shown.renderer->SetActiveCamera(in_vtk(quarter));
  shown.renderer->ResetCameraClippingRange();
  EXPECT_EQ(unlike(shown.pixels(), picture_of(mesh, bump(), quarter, settings()), kByte), 0);
}

// The same scene by VTK's ray caster. The ray of its pixel i of n runs through the place i / n of
// the window, and its picture is stretched by n / (n - 1) and interpolated, so that what a pixel's
// middle shows is the place (i + 1/2) (n - 1) / n^2. Our camera looks there.
TEST(VtkVolumeMapper, TakesThePlaceOfVtksRayCaster) {
  const Mesh mesh = generate("box-tetrahedra", {8, 0.2, 3});
  const auto data = in_vtk(mesh);
  Shown ours(data);
  vtkNew<vtkUnstructuredGridVolumeRayCastMapper> ray_caster;
  ray_caster->SetAutoAdjustSampleDistances(0);
  vtkNew<vtkUnstructuredGridLinearRayIntegrator> integrator;
  ray_caster->SetRayIntegrator(integrator);
  Shown theirs(data, ray_caster);
  // In other windows VTK's ray caster now and then draws as if they were square.
  constexpr int size = 200;
  for (const Shown* shown : {&ours, &theirs}) shown->window->SetSize(size, size);
  Camera camera = aside();
  constexpr double share = 1 - 1.0 / size;
  camera.view_angle =
      2 * std::atan(std::tan(camera.view_angle / 2 * M_PI / 180) * share) * 180 / M_PI;
  camera.window_center = {-1 / (size * share), -1 / (size * share)};
  ours.renderer->SetActiveCamera(in_vtk(camera));
  ours.renderer->ResetCameraClippingRange();

  const auto our_pixels = ours.pixels(), their_pixels = theirs.pixels();
  double sum = 0, brightness = 0;
  int far_off = 0;
  for (std::size_t i = 0; i < our_pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double difference = std::abs(our_pixels[i][c] - their_pixels[i][c]);
      sum += difference;
      brightness += our_pixels[i][c];
      far_off += difference > 0.02;
    }
  const double pixels = static_cast<double>(our_pixels.size());
  EXPECT_GT(brightness / pixels / 3, 0.1);
  // It cuts bytes off, which is 0.002 on average, where we round; and it interpolates.
  EXPECT_LT(sum / pixels / 3, 0.002);
  EXPECT_LT(far_off, 0.005 * 3 * pixels);
}

// A sphere of one colour, without light.
vtkSmartPointer<vtkActor> sphere_at(const std::array<double, 3>& center, double radius,
                                    OpaqueSurface* same) {
  vtkNew<vtkSphereSource> source;
  source->SetCenter(center.data());
  source->SetRadius(radius);
  source->SetThetaResolution(40);
  source->SetPhiResolution(40);
  source->Update();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.9, 0.8, 0.1);
  actor->GetProperty()->LightingOff();

  vtkPolyData& data = *source->GetOutput();
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    same->points.emplace_back();
    data.GetPoint(i, same->points.back().data());
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < data.GetNumberOfCells(); ++i) {
    data.GetCellPoints(i, ids);
    same->triangles.push_back({static_cast<std::uint32_t>(ids->GetId(0)),
                               static_cast<std::uint32_t>(ids->GetId(1)),
                               static_cast<std::uint32_t>(ids->GetId(2))});
  }
  same->color = {0.9f, 0.8f, 0.1f};
  return actor;
}

// In front, inside (half out of it) and behind: what the library makes of the same triangles.
TEST(VtkVolumeMapper, OpaqueGeometryHidesWhatIsBehindIt) {
  const Mesh mesh = generate("box-tetrahedra", {8, 0.2, 3});
  SceneOptions options;
  options.field.name = "linear";
  options.keep_gradients = true;  // which light is asked to have
  Scene scene(mesh, options);
  scene.set_transfer_function(bump());
  RenderSettings flat = settings();
  flat.lighting = Lighting{{}, 1, 0, 0, 1, false};
  const Image alone = render(scene, aside(), settings()).image;
  // Windows have several samples a pixel unless they are told not to.
  for (const auto& [parallel, samples] :
       {std::pair{false, 0}, std::pair{true, 0}, std::pair{false, 4}})
    for (const auto& center : {std::array{1.2, 0.9, 1.6}, std::array{0.5, 0.5, 0.5},
                               std::array{0.9, 0.6, 0.9}, std::array{-0.5, 0.1, -0.6}}) {
      Camera camera = aside();
      camera.parallel = parallel;
      Shown shown(in_vtk(mesh));
      OpaqueSurface surface;
      shown.window->SetMultiSamples(samples);
      shown.renderer->AddActor(sphere_at(center, 0.3, &surface));
      shown.renderer->SetActiveCamera(in_vtk(camera));
      shown.renderer->ResetCameraClippingRange();
      scene.remove_surfaces();
      scene.add_surface(surface);
      const Image expected = render(scene, camera, flat).image;
      // A rasterizer and a ray may see another triangle, or none, at the sphere's outline; the
      // z-buffer's 2^-24 are nothing beside a byte.
      // Of several samples one depth counts, which lies up to half a pixel aside; there the outline
      // is smooth.
      const int count = unlike(shown.pixels(), expected, samples > 0 ? 0.05 : kBlended);
      EXPECT_LT(count, samples > 0 ? 250 : 25) << center[0] << (parallel ? ", parallel" : "");
      EXPECT_GT(unlike(shown.pixels(), alone, 0.05), 200) << center[0];
      // Without depth, the volume is drawn on top.
      shown.mapper->IntermixIntersectingGeometryOff();
      EXPECT_GT(unlike(shown.pixels(), expected, 0.05), center[0] < 0 ? -1 : 200);
    }
}

TEST(VtkVolumeMapper, HonoursClippingAndTheVolumesTransform) {
  const Mesh mesh = generate("box-tetrahedra", {6, 0.2, 3});
  Shown shown(in_vtk(mesh));
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.6, 0.5, 0.5);
  plane->SetNormal(-1, 0.3, 0);
  shown.mapper->AddClippingPlane(plane);
  RenderSettings clipped = settings();
  clipped.clip_planes = {{{0.6, 0.5, 0.5}, {-1, 0.3, 0}}};
  const Image cut = picture_of(mesh, bump(), aside(), clipped);
  EXPECT_EQ(unlike(shown.pixels(), cut, kByte), 0);
  EXPECT_GT(unlike(shown.pixels(), picture_of(mesh, bump(), aside(), settings()), 0.05), 200);

  // All of the world turned, scaled and moved: the same picture.
  vtkCamera& eye = *shown.renderer->GetActiveCamera();
  const auto in_world = [&shown](const double* point, double w) {
    const double in[4] = {point[0], point[1], point[2], w};
    std::array<double, 4> out;
    shown.volume->GetMatrix()->MultiplyPoint(in, out.data());
    return out;
  };
  shown.volume->RotateZ(30);
  shown.volume->RotateX(-20);
  shown.volume->SetScale(2.5);
  shown.volume->SetPosition(10, -20, 5);
  shown.volume->Update();
  const Camera camera = aside();
  eye.SetPosition(in_world(camera.position.data(), 1).data());
  eye.SetFocalPoint(in_world(camera.focal_point.data(), 1).data());
  eye.SetViewUp(in_world(camera.view_up.data(), 0).data());
  const auto origin = in_world(plane->GetOrigin(), 1), normal = in_world(plane->GetNormal(), 0);
  plane->SetOrigin(origin[0], origin[1], origin[2]);
  plane->SetNormal(normal[0], normal[1], normal[2]);
  shown.renderer->ResetCameraClippingRange();
  EXPECT_EQ(unlike(shown.pixels(), cut, kByte), 0);
  EXPECT_EQ(shown.mapper->GetMeshesMade(), 1);

  // The camera's own clipping range.
  Shown in_range(in_vtk(mesh));
  vtkCamera& near_sighted = *in_range.renderer->GetActiveCamera();
  const double middle = near_sighted.GetDistance();
  near_sighted.SetClippingRange(middle - 0.1, middle + 0.3);
  const double* const forward = near_sighted.GetDirectionOfProjection();
  RenderSettings between = settings();
  for (const auto& [distance, sense] :
       {std::pair{middle - 0.1, 1.0}, std::pair{middle + 0.3, -1.0}}) {
    ClipPlane at;
    for (std::size_t c = 0; c < 3; ++c) {
      at.point[c] = camera.position[c] + distance * forward[c];
      at.normal[c] = sense * forward[c];
    }
    between.clip_planes.push_back(at);
  }
  EXPECT_EQ(unlike(in_range.pixels(), picture_of(mesh, bump(), camera, between), kByte), 0);
}

TEST(VtkVolumeMapper, MakesNoMoreAnewThanHasChanged) {
  const Mesh mesh = generate("box-tetrahedra", {6, 0.2, 3});
  const auto data = in_vtk(mesh);
  vtkNew<vtkFloatArray> values;
  values->DeepCopy(data->GetPointData()->GetScalars());
  values->SetName("mine");
  data->GetPointData()->SetScalars(values);
  Shown shown(data);
  const auto made = [&] {
    shown.window->Render();
    return std::array{shown.mapper->GetMeshesMade(), shown.mapper->GetFieldsPut(),
                      shown.mapper->GetTransferFunctionsMade()};
  };
  using Counts = std::array<int, 3>;
  EXPECT_EQ(made(), (Counts{1, 0, 1}));
  shown.renderer->GetActiveCamera()->Azimuth(20);
  EXPECT_EQ(made(), (Counts{1, 0, 1}));
  shown.volume->GetProperty()->GetScalarOpacity()->AddPoint(5, 0.5);
  EXPECT_EQ(made(), (Counts{1, 0, 2}));
  values->FillValue(3);
  values->Modified();
  EXPECT_EQ(made(), (Counts{1, 1, 2}));
}

TEST(VtkVolumeMapper, ShowsMaxima) {
  const Mesh mesh = generate("box-tetrahedra", {6, 0.2, 3});
  Shown shown(in_vtk(mesh));
  shown.mapper->SetBlendModeToMaximumIntensity();
  RenderSettings maximum = settings();
  maximum.mode = Mode::maximum;
  EXPECT_EQ(unlike(shown.pixels(), picture_of(mesh, bump(), aside(), maximum), kByte), 0);
}

TEST(VtkVolumeMapper, SaysWhatIsWrongAndDrawsNothing) {
  const Mesh mesh = generate("blunt-body", {12, 0, 1});
  const auto expect_refused = [](Shown& shown, const std::string& words) {
    const auto heard = Heard::from(*shown.mapper.Get());
    for (const auto& pixel : shown.pixels()) ASSERT_EQ(pixel, (std::array<float, 3>{0, 0, 0}));
    EXPECT_NE(heard->errors.find(words), std::string::npos)
        << words << "; heard: " << heard->errors;
  };
  Shown vectors(in_vtk(mesh, "velocity"));
  expect_refused(vectors, "'velocity' has 3 components; say which");
  Shown unknown(in_vtk(mesh, "pressure"));
  unknown.mapper->SetScalarModeToUsePointFieldData();
  unknown.mapper->SelectScalarArray("enthalpy");
  expect_refused(unknown, "no such array of numbers to show; there are density (point)");
  Shown stretched(in_vtk(mesh, "pressure"));
  stretched.volume->SetScale(1, 2, 1);
  expect_refused(stretched, "vtkTransformFilter");
  Shown opaque(in_vtk(mesh, "pressure"));
  opaque.volume->GetProperty()->SetScalarOpacityUnitDistance(0);
  expect_refused(opaque, "unit distance");

  vtkNew<vtkUnstructuredGrid> nothing;
  vtkNew<vtkPlumeVolumeMapper> mapper;
  const auto heard = Heard::from(*mapper.Get());
  vtkNew<vtkVolume> volume;
  vtkNew<vtkRenderer> renderer;
  mapper->Render(renderer, volume);
  EXPECT_NE(heard->errors.find("no input"), std::string::npos);
  mapper->SetInputData(nothing);
  mapper->Render(renderer, volume);
  EXPECT_NE(heard->errors.find("no cells"), std::string::npos);
}

TEST(VtkVolumeMapper, StopsWhereTheWindowIsAborted) {
  const Mesh mesh = generate("box-tetrahedra", {8, 0.2, 3});
  Shown shown(in_vtk(mesh));
  vtkNew<vtkCallbackCommand> abort;
  int asked = 0;
  abort->SetClientData(&asked);
  abort->SetCallback([](vtkObject* object, unsigned long, void* data, void*) {
    ++*static_cast<int*>(data);
    static_cast<vtkRenderWindow*>(object)->SetAbortRender(1);
  });
  shown.window->AddObserver(vtkCommand::AbortCheckEvent, abort);
  // As when an interactor wants to go on.
  shown.window->SetDesiredUpdateRate(1);
  shown.mapper->SetNumberOfThreads(1);
  const auto heard = Heard::from(*shown.mapper.Get());
  for (const auto& pixel : shown.pixels()) ASSERT_EQ(pixel, (std::array<float, 3>{0, 0, 0}));
  EXPECT_GT(asked, 0);
  EXPECT_EQ(heard->errors, "");
}

}  // namespace
}  // namespace plume::test
