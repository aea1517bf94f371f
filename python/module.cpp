// The module plume._plume: what the Python package needs of the library. Its users are the
// package's own classes, which say what arguments mean.

#include <pybind11/stl.h>

#include "bindings.h"

PYBIND11_MODULE(_plume, m) {
  using namespace plume;
  m.doc() = "The compiled part of plume; see help(plume).";
  // Wrong input is a ValueError that can be told from others.
  pybind11::register_exception<Error>(m, "Error", PyExc_ValueError).attr("__doc__") =
      "What was wrong with what was given, and what to do about it.";
  m.def("version", &version);
  m.def("color_maps", &preset_names);
  m.def("views", &view_names);

  python::bind_mesh(m);
  python::bind_render(m);
  python::bind_scene(m);
}
