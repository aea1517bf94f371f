#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <tuple>

#include "bindings.h"

namespace plume::python {
namespace {

namespace py = pybind11;

Scene make_scene(const BorrowedMesh& mesh, const std::string& field, const std::string& cell_data,
                 bool keep_gradients, bool keep_field_order, bool keep_cell_numbers) {
  SceneOptions options;
  options.field.name = field;
  options.cell_data = chosen<CellData>(
      {{"constant", CellData::constant}, {"averaged", CellData::averaged}}, cell_data, "cell_data");
  options.keep_gradients = keep_gradients;
  options.keep_field_order = keep_field_order;
  options.keep_cell_numbers = keep_cell_numbers;
  const py::gil_scoped_release release;
  return Scene(mesh.mesh, options);
}

void set_color_map(Scene& scene, const std::optional<std::string>& name,
                   const std::optional<std::pair<double, double>>& range,
                   const std::vector<std::pair<double, double>>& opacities,
                   std::optional<double> unit_distance, double opacity_scale) {
  ColorMap map = scene.default_color_map();
  if (name) {
    const auto found = preset(*name);
    if (!found) {
      std::string names;
      for (const std::string& known : preset_names()) names += " " + known;
      throw Error("no colour map '" + *name + "'; there are:" + names);
    }
    map = *found;
  }
  if (name || range) {
    double low = scene.field().low, high = scene.field().high;
    if (range) std::tie(low, high) = *range;
    if (!(low < high))
      throw Error("a colour map from " + std::to_string(low) + " to " + std::to_string(high) +
                  ": give a range of two values that ascend");
    map = rescaled(std::move(map), low, high);
  }
  if (!opacities.empty()) map.opacities.clear();
  for (const auto& [x, opacity] : opacities) map.opacities.push_back({x, opacity});
  const double distance = unit_distance.value_or(scene.default_unit_distance());
  if (!(distance > 0) || !(opacity_scale >= 0))
    throw Error("a unit distance of " + std::to_string(distance) + " and an opacity scale of " +
                std::to_string(opacity_scale) + ": give positive numbers");
  scene.set_transfer_function(to_transfer_function(map, distance, opacity_scale));
}

using Rows = py::array_t<float, py::array::c_style | py::array::forcecast>;

// A table of so many columns.
void check_rows(const Rows& rows, py::ssize_t columns, const char* what) {
  if (rows.ndim() != 2 || rows.shape(1) != columns)
    throw Error(std::string(what) + ": give rows of " + std::to_string(columns) + " numbers");
}

void set_transfer_function(Scene& scene, const Rows& knots) {
  check_rows(knots, 5, "transfer function");
  TransferFunction function;
  const auto k = knots.unchecked<2>();
  for (py::ssize_t i = 0; i < k.shape(0); ++i)
    function.knots.push_back({k(i, 0), {k(i, 1), {k(i, 2), k(i, 3), k(i, 4)}}});
  scene.set_transfer_function(std::move(function));
}

void set_surfaces(Scene& scene, const Rows& isosurfaces, const Rows& intervals, bool show_volume) {
  check_rows(isosurfaces, 5, "isosurfaces");
  check_rows(intervals, 6, "intervals");
  Classification classification;
  if (show_volume) classification.volume = scene.transfer_function();
  const auto s = isosurfaces.unchecked<2>();
  for (py::ssize_t i = 0; i < s.shape(0); ++i)
    classification.isosurfaces.push_back({s(i, 0), s(i, 1), {s(i, 2), s(i, 3), s(i, 4)}});
  const auto v = intervals.unchecked<2>();
  for (py::ssize_t i = 0; i < v.shape(0); ++i)
    classification.intervals.push_back(
        {v(i, 0), v(i, 1), even_profile(v(i, 2), {v(i, 3), v(i, 4), v(i, 5)})});
  scene.set_classification(std::move(classification));
}

py::dict field_of(const Scene& scene) {
  const ScalarField& field = scene.field();
  py::dict d;
  d["name"] = field.name;
  d["association"] = field.association == Association::point ? "point" : "cell";
  d["range"] = py::make_tuple(field.low, field.high);
  d["not_finite"] = field.not_finite;
  return d;
}

}  // namespace

void bind_scene(py::module_& m) {
  py::class_<Scene>(m, "Scene")
      .def(py::init(&make_scene))
      .def("set_field",
           [](Scene& self, const BorrowedMesh& mesh, const std::string& field) {
             const py::gil_scoped_release release;
             self.set_field(mesh.mesh, {field, {}});
           })
      .def("set_color_map", &set_color_map)
      .def("set_transfer_function", &set_transfer_function)
      .def("set_surfaces", &set_surfaces)
      .def("field", &field_of)
      .def("bounds",
           [](const Scene& self) { return py::make_tuple(self.bounds().low, self.bounds().high); })
      .def("findings",
           [](const Scene& self) {
             std::vector<std::string> all;
             for (const Finding& finding : self.findings()) all.push_back(describe(finding));
             return all;
           })
      .def("form", &Scene::form)
      .def("cell_count", &Scene::cell_count)
      .def("bytes", &Scene::bytes)
      .def("view",
           [](const Scene& self, const std::string& name, double aspect_ratio) {
             return named_view(name, self.bounds(), aspect_ratio);
           })
      .def("render", &render_picture)
      .def("trace", &trace_ray);
}

}  // namespace plume::python
