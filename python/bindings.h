// What the files of the module plume._plume share.
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "plume/lib/plume.h"

namespace plume::python {

using Vector = std::array<double, 3>;

/// One of several values by its name; throws Error, listing the names, for another.
template <class Value>
Value chosen(const std::vector<std::pair<const char*, Value>>& values, const std::string& name,
             const char* what) {
  std::string names;
  for (const auto& [known, value] : values) {
    if (name == known) return value;
    names += std::string(names.empty() ? "" : ", ") + known;
  }
  throw Error(std::string("no ") + what + " '" + name + "'; there are: " + names);
}

/// A mesh of NumPy's arrays.
struct BorrowedMesh {
  Mesh mesh;
};

/// How a picture is made.
struct RenderArguments {
  RenderSettings settings;
  pybind11::object progress = pybind11::none();
};

/// The picture, its further channels by name, statistics, whether it was cancelled.
pybind11::tuple render_picture(const Scene& scene, const Camera& camera,
                               const RenderArguments& arguments);

/// The segments of one ray: t_in and t_out, s_in and s_out, and the cell of each.
pybind11::tuple trace_ray(const Scene& scene, const Vector& origin, const Vector& direction,
                          int order);

void bind_mesh(pybind11::module_& m);
void bind_render(pybind11::module_& m);
void bind_scene(pybind11::module_& m);

}  // namespace plume::python
