#include "plume/vtk/volume_mapper.h"

#include <vtkCamera.h>
#include <vtkDataSet.h>
#include <vtkInformation.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <chrono>
#include <new>
#include <optional>
#include <thread>

#include "plume/lib/render.h"
#include "plume/mesh/error.h"
#include "plume/vtk/kept_scene.h"
#include "plume/vtk/view_of.h"
#include "plume/vtk/window_pixels.h"

struct vtkPlumeVolumeMapper::Inside {
  plume::KeptScene scene{"the mapper's input"};
  std::optional<int> component;
  double tolerance = -1;
  int threads = 0;
  bool intermix = true;
};

vtkStandardNewMacro(vtkPlumeVolumeMapper);

vtkPlumeVolumeMapper::vtkPlumeVolumeMapper() : inside_(std::make_unique<Inside>()) {}
vtkPlumeVolumeMapper::~vtkPlumeVolumeMapper() = default;

int vtkPlumeVolumeMapper::FillInputPortInformation(int /*port*/, vtkInformation* information) {
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  return 1;
}

void vtkPlumeVolumeMapper::SetInputData(vtkDataSet* data) { SetInputDataInternal(0, data); }

void vtkPlumeVolumeMapper::SetComponent(int component) {
  if (inside_->component == component) return;
  inside_->component = component;
  Modified();
}
void vtkPlumeVolumeMapper::SetComponentToMagnitude() { SetComponent(-1); }

void vtkPlumeVolumeMapper::SetTolerance(double tolerance) {
  if (inside_->tolerance == tolerance) return;
  inside_->tolerance = tolerance;
  Modified();
}
double vtkPlumeVolumeMapper::GetTolerance() const { return inside_->tolerance; }

void vtkPlumeVolumeMapper::SetNumberOfThreads(int threads) {
  if (inside_->threads == threads) return;
  inside_->threads = threads;
  Modified();
}
int vtkPlumeVolumeMapper::GetNumberOfThreads() const { return inside_->threads; }

void vtkPlumeVolumeMapper::SetIntermixIntersectingGeometry(bool intermix) {
  if (inside_->intermix == intermix) return;
  inside_->intermix = intermix;
  Modified();
}
bool vtkPlumeVolumeMapper::GetIntermixIntersectingGeometry() const { return inside_->intermix; }

int vtkPlumeVolumeMapper::GetMeshesMade() const { return inside_->scene.meshes_made(); }
int vtkPlumeVolumeMapper::GetFieldsPut() const { return inside_->scene.fields_put(); }
int vtkPlumeVolumeMapper::GetTransferFunctionsMade() const { return inside_->scene.optics_made(); }

void vtkPlumeVolumeMapper::PrintSelf(ostream& os, vtkIndent indent) {
  Superclass::PrintSelf(os, indent);
  os << indent << "Component: ";
  if (!inside_->component)
    os << "(none chosen)\n";
  else if (*inside_->component < 0)
    os << "(magnitude)\n";
  else
    os << *inside_->component << "\n";
  os << indent << "Tolerance: " << inside_->tolerance << "\n";
  os << indent << "Number Of Threads: " << inside_->threads << "\n";
  os << indent << "Intermix Intersecting Geometry: " << (inside_->intermix ? "On\n" : "Off\n");
}

namespace {

// World coordinates to the data's.
plume::ClipPlane plane_in_data(vtkPlane& plane, vtkMatrix4x4& model) {
  vtkNew<vtkMatrix4x4> inverse;
  vtkMatrix4x4::Invert(&model, inverse);
  const double* const origin = plane.GetOrigin();
  const double* const normal = plane.GetNormal();
  const double world[4] = {origin[0], origin[1], origin[2], 1};
  double point[4];
  inverse->MultiplyPoint(world, point);
  plume::ClipPlane result;
  for (std::size_t c = 0; c < 3; ++c) {
    result.point[c] = point[c];
    result.normal[c] = 0;  // normals are transformed by the transpose of the other direction
    for (int row = 0; row < 3; ++row)
      result.normal[c] += model.GetElement(row, static_cast<int>(c)) * normal[row];
  }
  return result;
}

}  // namespace

void vtkPlumeVolumeMapper::Draw(vtkRenderer& renderer, vtkVolume& volume) {
  GetInputAlgorithm()->Update();
  vtkDataSet* const data = GetDataSetInput();
  if (data == nullptr) throw plume::Error("the mapper has no input; see SetInputConnection");
  plume::Scene& scene = inside_->scene.update(
      *data,
      [this](vtkDataSet& set) {
        int on_cells = 0;
        vtkDataArray* const values =
            GetScalars(&set, ScalarMode, ArrayAccessMode, ArrayId, ArrayName, on_cells);
        return plume::ChosenArray{values, on_cells != 0};
      },
      inside_->component, [this](const std::string& notice) { vtkWarningMacro(<< notice); });
  inside_->scene.show(volume.GetProperty());

  const plume::Viewport viewport = plume::viewport_of(renderer);
  if (viewport.width < 1 || viewport.height < 1) return;
  vtkCamera& eye = *renderer.GetActiveCamera();
  vtkMatrix4x4& model = *volume.GetMatrix();
  const plume::View view =
      plume::view_of(model, *eye.GetViewTransformMatrix(),
                     *eye.GetProjectionTransformMatrix(renderer.GetTiledAspectRatio(), -1, 1),
                     viewport.width, viewport.height);

  plume::RenderSettings settings;
  settings.width = viewport.width;
  settings.height = viewport.height;
  settings.threads = inside_->threads;
  if (BlendMode == MAXIMUM_INTENSITY_BLEND) settings.mode = plume::Mode::maximum;
  if (inside_->tolerance >= 0) settings.tolerance = {inside_->tolerance};
  settings.clip_planes = view.planes_that_cut(scene.bounds());
  for (int i = 0; i < GetNumberOfClippingPlanes(); ++i)
    settings.clip_planes.push_back(plane_in_data(*GetClippingPlanes()->GetItem(i), model));
  if (inside_->intermix) settings.depth_limit = plume::depth_limits(renderer, view, viewport);

  // The check may run the program's own observers, which belong to this thread.
  vtkRenderWindow& window = *renderer.GetRenderWindow();
  const auto here = std::this_thread::get_id();
  const plume::RenderResult result = plume::render(scene, view.camera, settings, [&](double share) {
    if (std::this_thread::get_id() != here) return window.GetAbortRender() == 0;
    UpdateProgress(share);
    return window.CheckAbortStatus() == 0;
  });
  if (!result.cancelled) plume::blend_over(renderer, result.image);
}

void vtkPlumeVolumeMapper::Render(vtkRenderer* renderer, vtkVolume* volume) {
  const auto start = std::chrono::steady_clock::now();
  if (GetNumberOfInputConnections(0) < 1) {
    vtkErrorMacro(<< "the mapper has no input; see SetInputConnection and SetInputData");
    return;
  }
  try {
    Draw(*renderer, *volume);
  } catch (const plume::Error& error) {
    vtkErrorMacro(<< error.what());
  } catch (const std::bad_alloc&) {
    vtkErrorMacro(<< "out of memory");
  }
  TimeToDraw = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
