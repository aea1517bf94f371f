// What a property of VTK's looks like: its functions, sampled, and its own integrator.

#include "plume/vtk/transfer_function_of.h"

#include <gtest/gtest.h>
#include <vtkDoubleArray.h>
#include <vtkUnstructuredGridLinearRayIntegrator.h>
#include <vtkVolume.h>

#include <functional>

#include "plume/mesh/error.h"
#include "plume/tests/vtk/vtk_scenes.h"

namespace plume::test {
namespace {

// Away from steps, where one of the two sides is as good as the other.
void expect_as_vtk_says(vtkVolumeProperty& property, double low, double high,
                        double color_tolerance, double opacity_tolerance,
                        const std::vector<double>& steps = {}) {
  const TransferFunction function = transfer_function_of(property);
  ASSERT_FALSE(function.problem());
  for (int i = 0; i <= 3000; ++i) {
    const double x = low + (high - low) * i / 3000;
    bool at_step = false;
    for (const double step : steps) at_step |= std::abs(x - step) < 1e-3;
    if (at_step) continue;
    const Optics optics = function.at(static_cast<float>(x));
    double rgb[3];
    if (property.GetColorChannels() == 1)
      std::fill_n(rgb, 3, property.GetGrayTransferFunction()->GetValue(x));
    else
      property.GetRGBTransferFunction()->GetColor(x, rgb);
    for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(optics.color[c], rgb[c], color_tolerance) << x;
    ASSERT_NEAR(optics.extinction * property.GetScalarOpacityUnitDistance(),
                property.GetScalarOpacity()->GetValue(x), opacity_tolerance)
        << x;
  }
}

TEST(VtkTransferFunction, LinearOnesAreTheirPoints) {
  const auto property = property_of(bump());
  EXPECT_EQ(transfer_function_of(*property), bump());
  expect_as_vtk_says(*property, -1, 7, 1e-6, 1e-6);
}

TEST(VtkTransferFunction, GrayAndColourPointsOfTheirOwn) {
  vtkNew<vtkVolumeProperty> property;
  vtkNew<vtkPiecewiseFunction> gray, opacity;
  gray->AddPoint(-1, 0.25);
  gray->AddPoint(2.5, 1);
  opacity->AddPoint(0, 0.1);
  opacity->AddPoint(1, 0.9);
  opacity->AddPoint(4, 0);
  property->SetColor(gray);
  property->SetScalarOpacity(opacity);
  property->SetScalarOpacityUnitDistance(0.5);
  expect_as_vtk_says(*property, -2, 5, 1e-6, 1e-6);
  EXPECT_EQ(transfer_function_of(*property).knots.size(), 5u);
}

TEST(VtkTransferFunction, OtherSpacesAreFollowedToAThousandth) {
  for (const int space : {VTK_CTF_RGB, VTK_CTF_HSV, VTK_CTF_LAB, VTK_CTF_DIVERGING}) {
    const auto property = property_of(bump());
    property->GetRGBTransferFunction()->SetColorSpace(space);
    expect_as_vtk_says(*property, -1, 7, 1e-3, 1e-6);
  }
  // VTK searches for each colour of this space: 0.07 s.
  const auto slow = property_of(bump());
  slow->GetRGBTransferFunction()->SetColorSpaceToLabCIEDE2000();
  const TransferFunction function = transfer_function_of(*slow);
  for (const double x : {0.0, 0.31, 2.2, 5.9}) {
    double rgb[3];
    slow->GetRGBTransferFunction()->GetColor(x, rgb);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(function.at(static_cast<float>(x)).color[c], rgb[c], 2.0 / 255) << x;
  }

  const auto property = property_of(bump());
  property->GetRGBTransferFunction()->SetColorSpaceToStep();
  expect_as_vtk_says(*property, -1, 7, 1e-6, 1e-6, {0, 2, 3, 4, 6});
}

TEST(VtkTransferFunction, SharpnessAndMidpointsAreFollowed) {
  const auto property = property_of(bump());
  vtkPiecewiseFunction& opacity = *property->GetScalarOpacity();
  opacity.RemoveAllPoints();
  opacity.AddPoint(0, 0.1, 0.3, 0);
  opacity.AddPoint(1, 0.8, 0.7, 0.6);
  opacity.AddPoint(3, 0, 0.5, 1);  // a step halfway
  opacity.AddPoint(5, 0.9, 0.25, 0.2);
  opacity.AddPoint(6, 0.5);
  expect_as_vtk_says(*property, -1, 7, 1e-6, 1e-3, {4});
}

TEST(VtkTransferFunction, NothingBeyondFunctionsThatDoNotClamp) {
  const auto property = property_of(bump());
  property->GetScalarOpacity()->ClampingOff();
  property->GetRGBTransferFunction()->ClampingOff();
  expect_as_vtk_says(*property, -1, 7, 1e-6, 1e-6, {0, 6});
}

TEST(VtkTransferFunction, SaysWhatIsWrong) {
  const auto refuses = [](const std::function<void(vtkVolumeProperty&)>& spoil, const char* words) {
    const auto property = property_of(bump());
    spoil(*property);
    try {
      transfer_function_of(*property);
      ADD_FAILURE() << words;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refuses([](auto& p) { p.GetScalarOpacity()->RemoveAllPoints(); },
          "opacity function has no points");
  refuses([](auto& p) { p.GetRGBTransferFunction()->RemoveAllPoints(); },
          "RGB transfer function has no points");
  refuses([](auto& p) { p.SetScalarOpacityUnitDistance(0); }, "unit distance");
  refuses([](auto& p) { p.GetScalarOpacity()->AddPoint(1, -1); }, "extinction");
}

// VTK's integrator, fed with our segments, sees the picture that we make.
TEST(VtkTransferFunction, MeansWhatItMeansToVtksRayCaster) {
  const Mesh mesh = generate("box-tetrahedra", {6, 0.2, 3});
  Scene scene(mesh, {{"linear", {}}});
  const auto property = property_of(bump());
  scene.set_transfer_function(transfer_function_of(*property));
  RenderSettings settings;
  settings.width = settings.height = 24;
  settings.early_termination = 0;
  const Image image = render(scene, aside(), settings).image;

  vtkNew<vtkVolume> volume;
  volume->SetProperty(property);
  vtkNew<vtkDoubleArray> all, lengths, near, far;
  for (double value : {0.0, 6.0}) all->InsertNextValue(value);
  vtkNew<vtkUnstructuredGridLinearRayIntegrator> integrator;
  integrator->Initialize(volume, all);
  const PixelRays rays(aside(), settings.width, settings.height);
  double greatest = 0;
  for (int y = 0; y < settings.height; ++y)
    for (int x = 0; x < settings.width; ++x) {
      for (auto* array : {lengths.Get(), near.Get(), far.Get()}) array->Reset();
      scene.trace(rays(x + 0.5, y + 0.5), [&](const Segment& segment) {
        lengths->InsertNextValue(segment.t_out - segment.t_in);
        near->InsertNextValue(segment.s_in);
        far->InsertNextValue(segment.s_out);
        return true;
      });
      float rgba[4] = {0, 0, 0, 0};
      integrator->Integrate(lengths, near, far, rgba);
      for (int c = 0; c < 4; ++c)
        greatest =
            std::max(greatest, static_cast<double>(std::abs(rgba[c] - image.pixel(x, y)[c])));
    }
  EXPECT_LT(greatest, 1e-3);
  RecordProperty("greatest_difference", std::to_string(greatest));
}

}  // namespace
}  // namespace plume::test
