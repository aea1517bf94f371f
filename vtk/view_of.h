/// A camera of VTK's as one of ours, in the coordinates of the data.
#pragma once

#include <array>
#include <vector>

#include "plume/lib/camera.h"
#include "plume/lib/clip.h"

class vtkMatrix4x4;

namespace plume {

/// What VTK's matrices say of a picture.
struct View {
  Camera camera;  ///< in data coordinates
  /// How much longer a length is in world than in data coordinates.
  double scale = 1;
  /// Rows 2 and 3 of the projection as far as they are about z: depth = (a z + b) / (-z) of a
  /// perspective one, a z + b of a parallel one, in [-1, 1] between the clipping planes; z is that
  /// of the eye's coordinates, below 0 in front of it.
  double a = -1, b = 0;

  /// How far in front of the eye, in data coordinates along the line of sight, a z-buffer has
  /// `depth`, in [0, 1].
  double in_front(double depth) const;
  /// The clipping planes, as far as they cut the bounds.
  std::vector<ClipPlane> planes_that_cut(const Bounds& bounds) const;
};

/// `model` takes data to world coordinates, `view` world to the eye's, `projection` these to clip
/// coordinates from -1 to 1, for a picture of that size. All that vtkCamera knows is followed where
/// it comes to this: any perspective or parallel picture with square pixels, about the line of
/// sight or beside it (window centre, tiles, off-axis frusta). Throws Error for what is no such
/// picture: a volume or a user transform that shears, stretches one axis or mirrors, a view shear.
View view_of(vtkMatrix4x4& model, vtkMatrix4x4& view, vtkMatrix4x4& projection, int width,
             int height);

}  // namespace plume
