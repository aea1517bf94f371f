/// Light where rays of a frame meet isosurfaces and intervals.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "plume/lib/frame.h"
#include "plume/lib/scene_body.h"
#include "plume/lib/shading.h"

namespace plume {

/// Keeps references. `cell` is of the walkable mesh, t along the ray in world units.
template <class Walkable>
class SurfaceLight {
 public:
  SurfaceLight(const Frame& frame, const Walkable& walkable) : frame_(frame), walkable_(walkable) {}

  bool is_on() const { return frame_.settings().lighting.has_value(); }
  bool on_intervals() const { return is_on() && frame_.settings().lighting->intervals; }

  /// Requires a scene that keeps gradients.
  std::array<double, 3> gradient(const Ray& ray, double t, std::uint32_t cell) const {
    std::array<double, 3> place;
    for (std::size_t a = 0; a < 3; ++a) place[a] = ray.origin[a] + t * ray.direction[a];
    return frame_.scene().body().gradients->at(walkable_.mesh, cell, place);
  }

  /// Requires is_on().
  Shading shading(const Ray& ray, double t, std::uint32_t cell) const {
    return shading_of(*frame_.settings().lighting, gradient(ray, t, cell), ray.direction);
  }

 private:
  const Frame& frame_;
  const Walkable& walkable_;
};

}  // namespace plume
