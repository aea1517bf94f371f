// What tests of the VTK classes look at: meshes in VTK's hands, a camera, optics in both worlds.
#pragma once

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkCommand.h>
#include <vtkDataSet.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkVolumeProperty.h>

#include <cmath>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/io/vtk_from_mesh.h"
#include "plume/lib/plume.h"

namespace plume::test {

// The mesh as VTK has it; `field` are its active scalars. The mesh must outlive it.
inline vtkSmartPointer<vtkDataSet> in_vtk(const Mesh& mesh, const char* field = "linear") {
  vtkSmartPointer<vtkDataSet> data;
  if (mesh.is_rectilinear())
    data = rectilinear_from(mesh);
  else if (mesh.is_grid())
    data = structured_from(mesh);
  else
    data = unstructured_from(mesh);
  data->GetPointData()->SetActiveScalars(field);
  return data;
}

// Of "linear", which runs from 0 to 6 over the unit box: red to blue over green, with a bump.
inline TransferFunction bump() {
  return {{{0, {0.5f, {1, 0.25f, 0}}},
           {2, {1.5f, {0.5f, 1, 0}}},
           {3, {6, {0, 1, 0.5f}}},
           {4, {0, {0, 0.5f, 1}}},
           {6, {2, {0.25f, 0, 1}}}}};
}

constexpr double kUnitDistance = 0.125;

// The same as a property of VTK's, in which opacities are per unit distance.
inline vtkSmartPointer<vtkVolumeProperty> property_of(const TransferFunction& function) {
  vtkNew<vtkColorTransferFunction> color;
  vtkNew<vtkPiecewiseFunction> opacity;
  color->SetColorSpaceToRGB();
  for (const auto& knot : function.knots) {
    const auto& rgb = knot.optics.color;
    color->AddRGBPoint(knot.scalar, rgb[0], rgb[1], rgb[2]);
    opacity->AddPoint(knot.scalar, knot.optics.extinction * kUnitDistance);
  }
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetColor(color);
  property->SetScalarOpacity(opacity);
  property->SetScalarOpacityUnitDistance(kUnitDistance);
  return property;
}

// From aside at the unit box, in no special direction.
inline Camera aside() {
  Camera camera;
  camera.position = {2.1, 1.3, 2.7};
  camera.focal_point = {0.45, 0.5, 0.55};
  camera.view_up = {0.1, 1, -0.2};
  camera.view_angle = 32;
  camera.parallel_scale = 0.8;
  return camera;
}

inline vtkSmartPointer<vtkCamera> in_vtk(const Camera& camera) {
  auto eye = vtkSmartPointer<vtkCamera>::New();
  eye->SetPosition(camera.position.data());
  eye->SetFocalPoint(camera.focal_point.data());
  eye->SetViewUp(camera.view_up.data());
  eye->SetViewAngle(camera.view_angle);
  eye->SetParallelProjection(camera.parallel ? 1 : 0);
  eye->SetParallelScale(camera.parallel_scale);
  eye->SetWindowCenter(camera.window_center[0], camera.window_center[1]);
  return eye;
}

inline Image picture_of(const Mesh& mesh, const TransferFunction& function, const Camera& camera,
                        const RenderSettings& settings,
                        const FieldRequest& field = {"linear", {}}) {
  SceneOptions options;
  options.field = field;
  Scene scene(mesh, options);
  scene.set_transfer_function(function);
  return render(scene, camera, settings).image;
}

// Collects what an object says by vtkErrorMacro and vtkWarningMacro, which then is not printed.
class Heard : public vtkCommand {
 public:
  static vtkSmartPointer<Heard> from(vtkObject& object) {
    auto heard = vtkSmartPointer<Heard>::Take(new Heard);
    object.AddObserver(vtkCommand::ErrorEvent, heard);
    object.AddObserver(vtkCommand::WarningEvent, heard);
    return heard;
  }
  void Execute(vtkObject* /*object*/, unsigned long event, void* message) override {
    (event == vtkCommand::ErrorEvent ? errors : warnings) += static_cast<const char*>(message);
  }
  std::string errors, warnings;
};

}  // namespace plume::test
