/// Pictures by VTK's own ray caster for unstructured grids, from the same rays as Plume's.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plume/lib/camera.h"
#include "plume/lib/image.h"
#include "plume/mesh/mesh.h"
#include "plume/preint/transfer_function.h"

namespace plume::bench {

/// vtkUnstructuredGridVolumeRayCastMapper with Bunyk's walk, a ray a pixel; on one thread
/// unless set_threads() says otherwise.
///
/// Rays: VTK sends the ray of pixel (x, y) through the pixel's corner, not its centre; the camera's
/// window is moved by half a pixel, so that they are PixelRays'. It takes lengths on a ray that is
/// off by up to a pixel (it divides by the width less one there), which in perspective adds some
/// 1e-4 to its errors.
///
/// Colours: VTK takes a transfer function's colours as they are, knows no gamma, composites them
/// premultiplied in single precision, and rounds down to 8 bits. So linear colours in give a linear
/// picture. Its opacity at unit distance is an attenuation: extinction times that distance.
class VtkFrames {
 public:
  /// The mesh's arrays are read where they are: it must outlive this. Requires tetrahedra, `field`
  /// one scalar a point, no two knots at the same scalar.
  VtkFrames(const Mesh& mesh, const std::string& field, const TransferFunction& transfer_function);
  ~VtkFrames();

  /// Names of VTK's integrators; the first is exact where the scalar is linear along a segment.
  static const std::vector<std::string>& integrators();

  /// The camera for what follows, and the pixels along each side.
  void look(const Camera& camera, int size);

  /// For what follows; at least 1.
  void set_threads(int threads);

  /// One frame as the mapper renders it, but for the display on a screen. As VTK does, ends a ray
  /// once its opacity is 0.99, after the 32 cells at hand. What depends on mesh, transfer function
  /// and integrator alone is kept from one frame to the next.
  void render(const std::string& integrator);

  /// The last frame rendered, its rays cast once more by the mapper's iterator and integrator, but
  /// with what VTK rounds kept in single precision, and rays followed to their end.
  Image picture() const;

  /// Pixels of the last frame whose 8 bits are not those of `picture`, rounded down; of pixels with
  /// an opacity below 0.99, as the others may have ended early.
  std::size_t pixels_unlike(const Image& picture) const;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace plume::bench
