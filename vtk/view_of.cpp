#include "plume/vtk/view_of.h"

#include <vtkMatrix4x4.h>
#include <vtkNew.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "plume/mesh/error.h"

namespace plume {
namespace {

using Vector = std::array<double, 3>;

// Of what a matrix may be off by and still be called a rotation, say: a thousandth of a pixel in a
// picture of a thousand.
constexpr double kRounding = 1e-6;

// The length that a matrix gives to all unit vectors, if it turns, scales and moves, no more.
double scale_of(vtkMatrix4x4& matrix) {
  const double determinant = matrix.Determinant();
  const double scale = std::cbrt(determinant);
  bool good = determinant > 0 && std::isfinite(determinant) && matrix.GetElement(3, 3) == 1;
  for (int i = 0; i < 3; ++i) {
    good = good && matrix.GetElement(3, i) == 0;
    for (int j = i; j < 3; ++j) {
      double product = 0;
      for (int k = 0; k < 3; ++k) product += matrix.GetElement(k, i) * matrix.GetElement(k, j);
      good = good && std::abs(product / (scale * scale) - (i == j ? 1 : 0)) < kRounding;
    }
  }
  if (!good)
    throw Error(
        "the transforms of volume and camera shear, mirror or stretch the data; only turning, "
        "moving "
        "and scaling alike along all axes is followed: transform the data by vtkTransformFilter");
  return scale;
}

Vector transformed(const vtkMatrix4x4& matrix, const Vector& v, double w) {
  const double in[4] = {v[0], v[1], v[2], w};
  double out[4];
  vtkMatrix4x4::MultiplyPoint(matrix.GetData(), in, out);
  return {out[0], out[1], out[2]};
}

}  // namespace

double View::in_front(double depth) const {
  const double ndc = 2 * depth - 1;
  const double z = camera.parallel ? (ndc - b) / a : -b / (ndc + a);
  return -z / scale;
}

std::vector<ClipPlane> View::planes_that_cut(const Bounds& bounds) const {
  Vector forward;
  double length = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    forward[c] = camera.focal_point[c] - camera.position[c];
    length += forward[c] * forward[c];
  }
  for (double& c : forward) c /= std::sqrt(length);
  double nearest = HUGE_VAL, farthest = -HUGE_VAL;
  for (unsigned corner = 0; corner < 8; ++corner) {
    double along = 0;
    for (std::size_t c = 0; c < 3; ++c)
      along += ((corner >> c & 1) != 0 ? bounds.high[c] : bounds.low[c]) * forward[c] -
               camera.position[c] * forward[c];
    nearest = std::min(nearest, along);
    farthest = std::max(farthest, along);
  }
  std::vector<ClipPlane> planes;
  const auto add = [&](double distance, double sense) {
    ClipPlane plane;
    for (std::size_t c = 0; c < 3; ++c) {
      plane.point[c] = camera.position[c] + distance * forward[c];
      plane.normal[c] = sense * forward[c];
    }
    planes.push_back(plane);
  };
  const double near = in_front(0), far = in_front(1);
  // What is behind the eye of a perspective camera is not seen in any case.
  if (nearest < near && (camera.parallel || farthest > 0)) add(near, 1);
  if (farthest > far) add(far, -1);
  return planes;
}

View view_of(vtkMatrix4x4& model, vtkMatrix4x4& view, vtkMatrix4x4& projection, int width,
             int height) {
  vtkNew<vtkMatrix4x4> to_eye, from_eye;
  vtkMatrix4x4::Multiply4x4(&view, &model, to_eye);
  View result;
  result.scale = scale_of(*to_eye);
  vtkMatrix4x4::Invert(to_eye, from_eye);

  // | px 0  cx mx |
  // | 0  py cy my |  with (0 0 -1 0) of a perspective and (0 0 0 1) of a parallel projection below.
  // | 0  0  a  b  |
  const auto p = [&](int row, int column) { return projection.GetElement(row, column); };
  const bool perspective = p(3, 2) == -1 && p(3, 3) == 0;
  const bool parallel = p(3, 2) == 0 && p(3, 3) == 1;
  const double aspect_ratio = static_cast<double>(width) / height;
  const bool good =
      (perspective ? p(0, 3) == 0 && p(1, 3) == 0 : parallel && p(0, 2) == 0 && p(1, 2) == 0) &&
      p(3, 0) == 0 && p(3, 1) == 0 && p(0, 1) == 0 && p(1, 0) == 0 && p(2, 0) == 0 &&
      p(2, 1) == 0 && p(0, 0) > 0 && p(1, 1) > 0;
  if (!good)
    throw Error(
        "the camera's projection is sheared (a view shear, stereo, a user transform); Plume "
        "follows "
        "perspective and parallel projections");
  if (!(std::abs(p(1, 1) / p(0, 0) / aspect_ratio - 1) < kRounding))
    throw Error("the pixels are not square: " + std::to_string(width) + " x " +
                std::to_string(height) + " of them show a window of the aspect ratio " +
                std::to_string(p(1, 1) / p(0, 0)) +
                "; choose a window, viewport and camera of one aspect ratio");

  result.a = p(2, 2);
  result.b = p(2, 3);
  Camera& camera = result.camera;
  camera.position = transformed(*from_eye, {0, 0, 0}, 1);
  camera.view_up = transformed(*from_eye, {0, 1, 0}, 0);
  camera.parallel = parallel;
  if (parallel) {
    camera.parallel_scale = 1 / p(1, 1) / result.scale;
    camera.window_center = {-p(0, 3), -p(1, 3)};
  } else {
    camera.view_angle = 2 * std::atan(1 / p(1, 1)) * 180 / std::numbers::pi;
    camera.window_center = {p(0, 2), p(1, 2)};
  }
  // As far away as the far clipping plane, so that neither point is rounded to the other.
  const double far = result.in_front(1) * result.scale;
  camera.focal_point = transformed(*from_eye, {0, 0, std::isfinite(far) && far > 0 ? -far : -1}, 1);
  return result;
}

}  // namespace plume
