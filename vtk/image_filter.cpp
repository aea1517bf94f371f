#include "plume/vtk/image_filter.h"

#include <vtkCamera.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataSet.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <optional>
#include <string>
#include <thread>

#include "plume/lib/render.h"
#include "plume/mesh/error.h"
#include "plume/vtk/kept_scene.h"
#include "plume/vtk/view_of.h"

struct vtkPlumeImageFilter::Inside {
  plume::KeptScene scene{"the filter's input"};
  vtkSmartPointer<vtkVolumeProperty> property;
  vtkSmartPointer<vtkCamera> camera;
  std::array<int, 2> size{1024, 768};
  int type = VTK_FLOAT;
  bool depth = false;
  std::optional<int> component;
  double tolerance = -1;
  int threads = 0;
};

vtkStandardNewMacro(vtkPlumeImageFilter);

vtkPlumeImageFilter::vtkPlumeImageFilter() : inside_(std::make_unique<Inside>()) {
  SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS,
                         vtkDataSetAttributes::SCALARS);
}
vtkPlumeImageFilter::~vtkPlumeImageFilter() = default;

namespace {

template <class Owner, class Member, class Value>
void set(Owner& owner, Member& member, const Value& value) {
  if (member == value) return;
  member = value;
  owner.Modified();
}

}  // namespace

void vtkPlumeImageFilter::SetVolumeProperty(vtkVolumeProperty* property) {
  set(*this, inside_->property, property);
}
vtkVolumeProperty* vtkPlumeImageFilter::GetVolumeProperty() const { return inside_->property; }
void vtkPlumeImageFilter::SetActiveCamera(vtkCamera* camera) {
  set(*this, inside_->camera, camera);
}
vtkCamera* vtkPlumeImageFilter::GetActiveCamera() const { return inside_->camera; }
void vtkPlumeImageFilter::SetSize(int width, int height) {
  set(*this, inside_->size, std::array<int, 2>{width, height});
}
const int* vtkPlumeImageFilter::GetSize() const { return inside_->size.data(); }
void vtkPlumeImageFilter::SetOutputScalarTypeToUnsignedChar() {
  set(*this, inside_->type, VTK_UNSIGNED_CHAR);
}
void vtkPlumeImageFilter::SetOutputScalarTypeToFloat() { set(*this, inside_->type, VTK_FLOAT); }
void vtkPlumeImageFilter::SetComputeDepth(bool depth) { set(*this, inside_->depth, depth); }
bool vtkPlumeImageFilter::GetComputeDepth() const { return inside_->depth; }
void vtkPlumeImageFilter::SetComponent(int component) { set(*this, inside_->component, component); }
void vtkPlumeImageFilter::SetComponentToMagnitude() { SetComponent(-1); }
void vtkPlumeImageFilter::SetTolerance(double tolerance) {
  set(*this, inside_->tolerance, tolerance);
}
double vtkPlumeImageFilter::GetTolerance() const { return inside_->tolerance; }
void vtkPlumeImageFilter::SetNumberOfThreads(int threads) { set(*this, inside_->threads, threads); }
int vtkPlumeImageFilter::GetNumberOfThreads() const { return inside_->threads; }
int vtkPlumeImageFilter::GetMeshesMade() const { return inside_->scene.meshes_made(); }
int vtkPlumeImageFilter::GetFieldsPut() const { return inside_->scene.fields_put(); }
int vtkPlumeImageFilter::GetTransferFunctionsMade() const { return inside_->scene.optics_made(); }

vtkMTimeType vtkPlumeImageFilter::GetMTime() {
  vtkMTimeType time = Superclass::GetMTime();
  if (inside_->camera) time = std::max(time, inside_->camera->GetMTime());
  if (inside_->property) time = std::max(time, inside_->property->GetMTime());
  return time;
}

void vtkPlumeImageFilter::PrintSelf(ostream& os, vtkIndent indent) {
  Superclass::PrintSelf(os, indent);
  os << indent << "Size: " << inside_->size[0] << " x " << inside_->size[1] << "\n";
  os << indent << "Volume Property: " << inside_->property.Get() << "\n";
  os << indent << "Active Camera: " << inside_->camera.Get() << "\n";
  os << indent
     << "Output Scalar Type: " << (inside_->type == VTK_FLOAT ? "float\n" : "unsigned char\n");
  os << indent << "Compute Depth: " << (inside_->depth ? "On\n" : "Off\n");
  os << indent << "Tolerance: " << inside_->tolerance << "\n";
  os << indent << "Number Of Threads: " << inside_->threads << "\n";
}

int vtkPlumeImageFilter::FillInputPortInformation(int /*port*/, vtkInformation* information) {
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  information->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkPlumeImageFilter::RequestInformation(vtkInformation* /*request*/,
                                            vtkInformationVector** /*inputs*/,
                                            vtkInformationVector* outputs) {
  vtkInformation* const output = outputs->GetInformationObject(0);
  const int extent[6] = {0, inside_->size[0] - 1, 0, inside_->size[1] - 1, 0, 0};
  const double spacing[3] = {1, 1, 1}, origin[3] = {0, 0, 0};
  output->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  output->Set(vtkDataObject::SPACING(), spacing, 3);
  output->Set(vtkDataObject::ORIGIN(), origin, 3);
  vtkDataObject::SetPointDataActiveScalarInfo(output, inside_->type, 4);
  return 1;
}

int vtkPlumeImageFilter::RequestUpdateExtent(vtkInformation* /*request*/,
                                             vtkInformationVector** inputs,
                                             vtkInformationVector* /*outputs*/) {
  vtkInformation* const input = inputs[0]->GetInformationObject(0);
  if (input->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
    input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(),
               input->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()), 6);
  return 1;
}

namespace {

// VTK's first row is the lowest. `give` is called for each pixel with its place in both.
template <class Give>
void for_each_pixel(const plume::Image& image, const Give& give) {
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) give(y * width + x, (height - 1 - y) * width + x);
}

void put_colors(const plume::Image& image, vtkFloatArray& colors) {
  float* const out = colors.GetPointer(0);
  for_each_pixel(image, [&](std::size_t from, std::size_t to) {
    std::copy_n(&image.rgba[4 * from], 4, out + 4 * to);
  });
}

void put_colors(const plume::Image& image, vtkUnsignedCharArray& colors) {
  unsigned char* const out = colors.GetPointer(0);
  const auto as_byte = [](float value) {
    return static_cast<unsigned char>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
  };
  for_each_pixel(image, [&](std::size_t from, std::size_t to) {
    const float* const rgba = &image.rgba[4 * from];
    for (std::size_t c = 0; c < 3; ++c)
      out[4 * to + c] = rgba[3] > 0 ? as_byte(rgba[c] / rgba[3]) : 0;
    out[4 * to + 3] = as_byte(rgba[3]);
  });
}

template <class Colors>
void put_scalars(const plume::Image& image, vtkImageData& output) {
  vtkNew<Colors> colors;
  colors->SetName("RGBA");
  colors->SetNumberOfComponents(4);
  colors->SetNumberOfTuples(output.GetNumberOfPoints());
  put_colors(image, *colors.Get());
  output.GetPointData()->SetScalars(colors);
}

plume::Camera camera_of(vtkCamera* camera, const plume::Bounds& bounds, int width, int height) {
  const double aspect_ratio = static_cast<double>(width) / height;
  if (camera == nullptr) return plume::fitted_camera(bounds, {0, 0, -1}, {0, 1, 0}, aspect_ratio);
  vtkNew<vtkMatrix4x4> still;
  return plume::view_of(*still.Get(), *camera->GetViewTransformMatrix(),
                        *camera->GetProjectionTransformMatrix(aspect_ratio, -1, 1), width, height)
      .camera;
}

}  // namespace

void vtkPlumeImageFilter::Draw(vtkDataObject& data, vtkImageData& output) {
  const auto [width, height] = inside_->size;
  if (width < 1 || height < 1)
    throw plume::Error("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                       " pixels; give a size of at least 1 x 1 (SetSize)");
  plume::RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.threads = inside_->threads;
  if (inside_->tolerance >= 0) settings.tolerance = {inside_->tolerance};
  if (inside_->depth) settings.channels = {"depth"};

  plume::Scene& scene = inside_->scene.update(
      data,
      [this](vtkDataSet& set) {
        int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
        vtkDataArray* const values = GetInputArrayToProcess(0, &set, association);
        return plume::ChosenArray{values, association == vtkDataObject::FIELD_ASSOCIATION_CELLS};
      },
      inside_->component, [this](const std::string& notice) { vtkWarningMacro(<< notice); });
  inside_->scene.show(inside_->property);
  const plume::Camera camera = camera_of(inside_->camera, scene.bounds(), width, height);

  const auto here = std::this_thread::get_id();
  const plume::RenderResult result = plume::render(scene, camera, settings, [&](double share) {
    // Observers belong to this thread.
    if (std::this_thread::get_id() == here) UpdateProgress(share);
    return GetAbortExecute() == 0;
  });
  if (result.cancelled) return;

  output.SetExtent(0, width - 1, 0, height - 1, 0, 0);
  if (inside_->type == VTK_FLOAT)
    put_scalars<vtkFloatArray>(result.image, output);
  else
    put_scalars<vtkUnsignedCharArray>(result.image, output);
  if (inside_->depth) {
    vtkNew<vtkFloatArray> depth;
    depth->SetName("depth");
    depth->SetNumberOfTuples(output.GetNumberOfPoints());
    const std::vector<float>& distances = result.image.channel("depth")->values;
    for_each_pixel(result.image, [&](std::size_t from, std::size_t to) {
      depth->SetValue(static_cast<vtkIdType>(to), distances[from]);
    });
    output.GetPointData()->AddArray(depth);
  }
}

int vtkPlumeImageFilter::RequestData(vtkInformation* /*request*/, vtkInformationVector** inputs,
                                     vtkInformationVector* outputs) {
  vtkDataObject* const data = vtkDataObject::GetData(inputs[0]);
  vtkImageData* const output = vtkImageData::GetData(outputs);
  output->Initialize();
  try {
    Draw(*data, *output);
    return 1;
  } catch (const plume::Error& error) {
    vtkErrorMacro(<< error.what());
  } catch (const std::bad_alloc&) {
    vtkErrorMacro(<< "out of memory");
  }
  return 0;
}
