/// Where a picture is taken from, in the terms of VTK's users.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "plume/mesh/local_frame.h"
#include "plume/traverse/ray.h"

namespace plume {

/// Position and lens, in world coordinates.
struct Camera {
  std::array<double, 3> position{0, 0, 1};     ///< of the eye
  std::array<double, 3> focal_point{0, 0, 0};  ///< what it looks at
  std::array<double, 3> view_up{0, 1, 0};      ///< not along the line of sight
  /// Degrees from the bottom to the top of the picture, in (0, 180). Perspective only.
  double view_angle = 30;
  /// Parallel projection: all rays have the direction of the line of sight.
  bool parallel = false;
  /// Half of the picture's height in world units, > 0. Parallel projection only.
  double parallel_scale = 1;
  /// Where the middle of the picture is, in halves of its width and height to the right of the line
  /// of sight and above it: off the middle for a part of a larger picture.
  std::array<double, 2> window_center{0, 0};

  /// The same in every number.
  bool operator==(const Camera&) const = default;
};

/// A camera that looks along `direction` at the centre of `bounds` and sees just all of them, with
/// a margin of 5%, in a picture of that aspect ratio (width / height). `view_up` may be any
/// direction but that of sight; zero lets us choose. Throws Error where the direction is zero.
Camera fitted_camera(const Bounds& bounds, const std::array<double, 3>& direction,
                     const std::array<double, 3>& view_up = {0, 0, 0}, double aspect_ratio = 1);

/// A named view, fitted: "+x" looks along +x, as ParaView's button of that name; likewise -x, +y,
/// -y, +z, -z; "iso" looks along (-1, -1, -1). Throws Error, listing the names, for another.
Camera named_view(const std::string& name, const Bounds& bounds, double aspect_ratio = 1);
/// What named_view() knows.
std::vector<std::string> view_names();

/// Turns the camera about the focal point, around view up (azimuth) and around the axis across the
/// picture (elevation), in degrees, as vtkCamera does.
void orbit(Camera& camera, double azimuth, double elevation);

/// Makes what is seen larger (> 1) or smaller: narrows the view angle or the parallel scale, as
/// vtkCamera's Zoom. Throws Error unless factor > 0.
void zoom(Camera& camera, double factor);

struct RayLanes;

/// What the rays of a picture's pixels are worked out from.
struct PixelLens {
  std::array<double, 3> position{};       ///< Camera::position
  std::array<double, 3> forward{};        ///< of length one, as are the next two
  std::array<double, 3> right{};          ///< across the picture
  std::array<double, 3> up{};             ///< and from its bottom to its top
  double half_width = 0;                  ///< of the picture, at a distance of one or in parallel
  double half_height = 0;                 ///< likewise
  double pixels_x = 0;                    ///< of the picture
  double pixels_y = 0;                    ///< likewise
  std::array<double, 2> window_center{};  ///< Camera::window_center
  bool parallel = false;                  ///< Camera::parallel
};

/// The rays of a picture's pixels.
class PixelRays {
 public:
  /// Throws Error, naming the value, where the camera makes no picture: position at the focal
  /// point, view up along the line of sight or zero, an angle or scale out of range.
  PixelRays(const Camera& camera, int width, int height);

  /// The ray through the place (x, y), in pixels from the top left corner; the centre of pixel
  /// (0, 0) is (0.5, 0.5). Its direction has length one.
  Ray operator()(double x, double y) const;

  /// Those of sixteen places, to the bit, of which the first `size` count.
  void set(RayLanes& rays, const std::array<double, 16>& x, const std::array<double, 16>& y,
           std::size_t size) const;

 private:
  PixelLens lens_;
};

}  // namespace plume
