#include "plume/tests/bench/vtk_frames.h"

#include <vtkCamera.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridHomogeneousRayIntegrator.h>
#include <vtkUnstructuredGridLinearRayIntegrator.h>
#include <vtkUnstructuredGridPartialPreIntegration.h>
#include <vtkUnstructuredGridPreIntegration.h>
#include <vtkUnstructuredGridVolumeRayCastFunction.h>
#include <vtkUnstructuredGridVolumeRayCastIterator.h>
#include <vtkUnstructuredGridVolumeRayCastMapper.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "plume/io/vtk_from_mesh.h"
#include "plume/mesh/error.h"
#include "plume/tests/bench/vtk_view.h"

namespace plume::bench {
namespace {

// Faces seen edge-on make scalars that are not finite, with which this integrator reads outside of
// its table and crashes. A pixel that meets one is made not a number, as those of the others are.
class GuardedPartialPreIntegration : public vtkUnstructuredGridPartialPreIntegration {
 public:
  static GuardedPartialPreIntegration* New() { return made<GuardedPartialPreIntegration>(); }

  void Integrate(vtkDoubleArray* lengths, vtkDataArray* front, vtkDataArray* back,
                 float color[4]) override {
    bool finite = true;
    for (vtkIdType i = 0; i < lengths->GetNumberOfTuples(); ++i)
      finite = finite && std::isfinite(lengths->GetValue(i)) &&
               std::isfinite(front->GetComponent(i, 0)) && std::isfinite(back->GetComponent(i, 0));
    if (finite)
      vtkUnstructuredGridPartialPreIntegration::Integrate(lengths, front, back, color);
    else
      std::fill_n(color, 4, std::numeric_limits<float>::quiet_NaN());
  }
};

template <class Integrator>
vtkSmartPointer<vtkUnstructuredGridVolumeRayIntegrator> make() {
  return vtkSmartPointer<Integrator>::New();
}

struct NamedIntegrator {
  std::string name;
  vtkSmartPointer<vtkUnstructuredGridVolumeRayIntegrator> (*make)();
};
const std::vector<NamedIntegrator>& all_integrators() {
  static const std::vector<NamedIntegrator> all{
      {"linear", make<vtkUnstructuredGridLinearRayIntegrator>},
      {"partial pre-integration", make<GuardedPartialPreIntegration>},
      {"pre-integration", make<vtkUnstructuredGridPreIntegration>},
      {"homogeneous", make<vtkUnstructuredGridHomogeneousRayIntegrator>}};
  return all;
}

}  // namespace

struct VtkFrames::Pipeline {
  vtkSmartPointer<vtkDataSet> data;
  vtkDataArray* scalars = nullptr;
  // One for each integrator, as a mapper with its own would keep it.
  std::vector<vtkSmartPointer<vtkUnstructuredGridVolumeRayIntegrator>> integrators;
  vtkNew<BlindRenderer> renderer;
  vtkNew<BlindWindow> window;
  vtkNew<vtkVolume> volume;
  vtkSmartPointer<vtkUnstructuredGridVolumeRayCastMapper> mapper;
  int size = 0;
};

VtkFrames::VtkFrames(const Mesh& mesh, const std::string& field,
                     const TransferFunction& transfer_function)
    : pipeline_(std::make_unique<Pipeline>()) {
  keep_pictures_off_the_screen();
  Pipeline& p = *pipeline_;
  p.data = unstructured_from(mesh);
  p.scalars = p.data->GetPointData()->GetArray(field.c_str());
  if (p.scalars == nullptr) throw Error("VTK's mesh has no point field '" + field + "'");
  p.mapper = vtkSmartPointer<vtkUnstructuredGridVolumeRayCastMapper>::New();
  p.mapper->SetInputData(vtkUnstructuredGrid::SafeDownCast(p.data));
  p.mapper->SetScalarModeToUsePointFieldData();
  p.mapper->SelectScalarArray(field.c_str());
  p.mapper->SetAutoAdjustSampleDistances(0);
  p.mapper->SetImageSampleDistance(1);
  p.mapper->SetIntermixIntersectingGeometry(0);
  p.mapper->SetNumberOfThreads(1);
  p.volume->SetMapper(p.mapper);
  set_optics(*p.volume->GetProperty(), transfer_function);
  p.window->AddRenderer(p.renderer);
  for (const NamedIntegrator& one : all_integrators()) p.integrators.push_back(one.make());
}

VtkFrames::~VtkFrames() = default;

const std::vector<std::string>& VtkFrames::integrators() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> made;
    for (const NamedIntegrator& one : all_integrators()) made.push_back(one.name);
    return made;
  }();
  return names;
}

void VtkFrames::look(const Camera& camera, int size) {
  Pipeline& p = *pipeline_;
  p.size = size;
  p.window->SetSize(size, size);
  vtkCamera& eye = *p.renderer->GetActiveCamera();
  aim(eye, camera, p.data->GetBounds());
  eye.SetWindowCenter(1.0 / size, 1.0 / size);
}

void VtkFrames::set_threads(int threads) { pipeline_->mapper->SetNumberOfThreads(threads); }

void VtkFrames::render(const std::string& integrator) {
  Pipeline& p = *pipeline_;
  const auto& names = integrators();
  const auto at = std::find(names.begin(), names.end(), integrator) - names.begin();
  p.mapper->SetRayIntegrator(p.integrators.at(static_cast<std::size_t>(at)));
  p.mapper->Render(p.renderer, p.volume);
}

Image VtkFrames::picture() const {
  Pipeline& p = *pipeline_;
  Image image;
  image.width = image.height = p.size;
  const auto side = static_cast<std::size_t>(p.size);
  image.rgba.assign(4 * side * side, 0);
  const auto iterator = vtkSmartPointer<vtkUnstructuredGridVolumeRayCastIterator>::Take(
      p.mapper->GetRayCastFunction()->NewIterator());
  vtkNew<vtkDoubleArray> lengths;
  const auto like_scalars = [&p] {
    return vtkSmartPointer<vtkDataArray>::Take(
        vtkDataArray::CreateDataArray(p.scalars->GetDataType()));
  };
  const auto front = like_scalars(), back = like_scalars();
  for (std::size_t y = 0; y < side; ++y)
    for (std::size_t x = 0; x < side; ++x) {
      iterator->SetBounds(0, 1);
      iterator->Initialize(static_cast<int>(x), static_cast<int>(y));
      float* rgba = &image.rgba[4 * ((side - 1 - y) * side + x)];  // VTK's first row is the lowest
      while (iterator->GetNextIntersections(nullptr, lengths, p.scalars, front, back) > 0)
        p.mapper->GetRayIntegrator()->Integrate(lengths, front, back, rgba);
    }
  return image;
}

std::size_t VtkFrames::pixels_unlike(const Image& picture) const {
  const auto side = static_cast<std::size_t>(pipeline_->size);
  std::size_t unlike = 0;
  for (std::size_t y = 0; y < side; ++y)
    for (std::size_t x = 0; x < side; ++x) {
      const float* rgba = &picture.rgba[4 * ((side - 1 - y) * side + x)];
      const unsigned char* shown =
          ImageTaker::taken + 4 * (y * static_cast<std::size_t>(ImageTaker::row) + x);
      if (!(rgba[3] < 0.99f)) continue;
      const bool alike = std::equal(rgba, rgba + 4, shown, [](float exact, unsigned char byte) {
        return std::isnan(exact) || static_cast<int>(std::min(exact * 255.0, 255.0)) == byte;
      });
      if (!alike) ++unlike;
    }
  return unlike;
}

}  // namespace plume::bench
