/// What VTK's mappers of unstructured grids are told: a camera, optics, and a screen that is none.
#pragma once

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPiecewiseFunction.h>
#include <vtkRayCastImageDisplayHelper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkVersion.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>

#include "plume/lib/camera.h"
#include "plume/mesh/error.h"
#include "plume/preint/transfer_function.h"

namespace plume::bench {

/// What vtkStandardNewMacro makes of New().
template <class Object>
Object* made() {
  auto* object = new Object;
  object->InitializeObjectBase();
  return object;
}

/// A renderer and a window that show nothing: mappers that compute their picture themselves ask
/// them for camera and size alone, and no graphics are needed.
class BlindRenderer : public vtkRenderer {
 public:
  static BlindRenderer* New() { return made<BlindRenderer>(); }
};

class BlindWindow : public vtkRenderWindow {
 public:
  static BlindWindow* New() { return made<BlindWindow>(); }
};

/// Takes a mapper's image instead of drawing it.
class ImageTaker : public vtkRayCastImageDisplayHelper {
 public:
  static ImageTaker* New() { return made<ImageTaker>(); }

  void RenderTexture(vtkVolume*, vtkRenderer*, int memory_size[2], int /*viewport_size*/[2],
                     int /*in_use_size*/[2], int /*origin*/[2], float /*depth*/,
                     unsigned char* image) override {
    row = memory_size[0];
    taken = image;
  }
  void RenderTexture(vtkVolume*, vtkRenderer*, int*, int*, int*, int*, float,
                     unsigned short*) override {}
  void RenderTexture(vtkVolume*, vtkRenderer*, vtkFixedPointRayCastImage*, float) override {}

  // Of the last frame of any mapper.
  static inline int row = 0;
  static inline const unsigned char* taken = nullptr;
};

inline vtkObject* make_image_taker() { return ImageTaker::New(); }

class TakerFactory : public vtkObjectFactory {
 public:
  static TakerFactory* New() { return made<TakerFactory>(); }
  const char* GetVTKSourceVersion() override { return VTK_SOURCE_VERSION; }
  const char* GetDescription() override { return "keeps pictures off the screen"; }

  TakerFactory() {
    RegisterOverride("vtkRayCastImageDisplayHelper", "ImageTaker", "no screen", 1,
                     make_image_taker);
  }
};

/// To be called before a mapper is made that is to draw into an ImageTaker.
inline void keep_pictures_off_the_screen() {
  static const bool registered = [] {
    vtkNew<TakerFactory> factory;
    vtkObjectFactory::RegisterFactory(factory);
    return true;
  }();
  static_cast<void>(registered);
}

/// Linear colours are taken as they are. VTK's opacity at `unit_distance` is an attenuation:
/// extinction times that distance. Throws Error where two knots are at one scalar, which VTK's
/// functions cannot say.
inline void set_optics(vtkVolumeProperty& property, const TransferFunction& transfer_function,
                       double unit_distance = 1) {
  vtkNew<vtkColorTransferFunction> color;
  vtkNew<vtkPiecewiseFunction> opacity;
  color->SetColorSpaceToRGB();
  const TransferFunction::Knot* before = nullptr;
  for (const TransferFunction::Knot& knot : transfer_function.knots) {
    if (before != nullptr && before->scalar == knot.scalar)
      throw Error("the transfer function has a step, which VTK's cannot have");
    before = &knot;
    const auto& rgb = knot.optics.color;
    color->AddRGBPoint(knot.scalar, rgb[0], rgb[1], rgb[2]);
    opacity->AddPoint(knot.scalar, knot.optics.extinction * unit_distance);
  }
  property.IndependentComponentsOn();
  property.SetColor(color);
  property.SetScalarOpacity(opacity);
  property.SetScalarOpacityUnitDistance(unit_distance);
  property.ShadeOff();
  property.SetInterpolationTypeToLinear();
}

/// Our camera as VTK's, its clipping planes just around `bounds` (low and high of x, y, z).
inline void aim(vtkCamera& eye, const Camera& camera, const double bounds[6]) {
  eye.SetPosition(camera.position.data());
  eye.SetFocalPoint(camera.focal_point.data());
  eye.SetViewUp(camera.view_up.data());
  eye.SetViewAngle(camera.view_angle);
  eye.SetParallelProjection(camera.parallel ? 1 : 0);
  eye.SetParallelScale(camera.parallel_scale);
  double near = eye.GetDistance() * 1e3, far = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double depth = 0;
    for (int a = 0; a < 3; ++a)
      depth += (bounds[2 * a + (corner >> a & 1)] - eye.GetPosition()[a]) *
               eye.GetDirectionOfProjection()[a];
    near = std::min(near, depth);
    far = std::max(far, depth);
  }
  eye.SetClippingRange(std::max(1e-3 * far, 0.99 * near), 1.01 * far);
}

}  // namespace plume::bench
