// The module plume._plume: what the Python package needs of the library. Its users are the
// package's own classes, which say what arguments mean.

#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "arrays.h"

namespace plume::python {
namespace {

namespace py = pybind11;
using Vector = std::array<double, 3>;

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

// A mesh of NumPy's arrays.
struct BorrowedMesh {
  Mesh mesh;

  void set_cells(const py::array& types, const py::object& offsets, const py::array& connectivity) {
    mesh.cells.types = borrow(types, "types");
    if (!offsets.is_none()) mesh.cells.offsets = borrow(offsets.cast<py::array>(), "offsets");
    mesh.cells.connectivity = borrow(connectivity, "connectivity");
  }
  void set_polyhedra(const py::array& faces, const py::array& locations) {
    mesh.cells.polyhedron_faces = borrow(faces, "polyhedron faces");
    mesh.cells.polyhedron_locations = borrow(locations, "polyhedron locations");
  }
  void set_axes(const std::array<py::array, 3>& axes) {
    for (std::size_t a = 0; a < 3; ++a) {
      mesh.axes[a] = borrow(axes[a], std::string("axis ") + "xyz"[a]);
      mesh.dimensions[a] = static_cast<std::int64_t>(mesh.axes[a].size());
    }
  }
  void add_field(const std::string& name, bool on_points, int components, const py::array& values) {
    mesh.fields.push_back({name, on_points ? Association::point : Association::cell, components,
                           borrow(values, "field '" + name + "'")});
  }
};

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

// Stops rendering when a signal's handler (Ctrl-C) or the user's function throws.
class PythonProgress {
 public:
  explicit PythonProgress(py::object function) : function_(std::move(function)) {}

  bool operator()(double share) {
    // Python runs the handlers of signals in its main thread alone: others need not ask.
    const bool caller = std::this_thread::get_id() == caller_;
    if (!caller && function_.is_none()) return true;
    const py::gil_scoped_acquire gil;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (function_.is_none()) return true;
      const py::object answer = function_(share);
      return answer.is_none() || answer.cast<bool>();
    } catch (py::error_already_set& error) {
      thrown_.emplace(error);
      return false;
    }
  }
  // With Python's lock held.
  void rethrow() {
    if (thrown_) throw py::error_already_set(*thrown_);
  }

 private:
  py::object function_;
  std::thread::id caller_ = std::this_thread::get_id();
  std::optional<py::error_already_set> thrown_;
};

struct RenderArguments {
  RenderSettings settings;
  py::object progress = py::none();
};

py::dict statistics_of(const RenderStatistics& s) {
  py::dict d;
  d["rays"] = s.rays;
  d["rays_hit"] = s.rays_hit;
  d["lost_rays"] = s.lost_rays;
  d["cells_visited"] = s.cells_visited;
  d["rays_in_packets"] = s.rays_in_packets;
  d["plan"] = s.plan;
  return d;
}

// The picture, its further channels by name, statistics, whether it was cancelled.
py::tuple render_picture(const Scene& scene, const Camera& camera,
                         const RenderArguments& arguments) {
  PythonProgress progress(arguments.progress);
  RenderResult result;
  {
    const py::gil_scoped_release release;
    result =
        render(scene, camera, arguments.settings, [&](double share) { return progress(share); });
  }
  progress.rethrow();
  const py::ssize_t width = result.image.width, height = result.image.height;
  py::dict channels;
  for (Channel& channel : result.image.channels)
    channels[py::str(channel.name)] = hand_over(std::move(channel.values), {height, width});
  return py::make_tuple(hand_over(std::move(result.image.rgba), {height, width, 4}), channels,
                        statistics_of(result.statistics), result.cancelled);
}

// The segments of one ray: t_in, t_out, s_in, s_out and the cell of each.
py::tuple trace_ray(const Scene& scene, const Vector& origin, const Vector& direction, int order) {
  if (order < 1 || order > 3) throw Error("order " + std::to_string(order) + ": 1, 2 or 3");
  std::vector<double> t;
  std::vector<float> s;
  std::vector<std::int64_t> cells;
  {
    const py::gil_scoped_release release;
    scene.trace(
        {origin, direction},
        [&](const Segment& segment) {
          t.insert(t.end(), {segment.t_in, segment.t_out});
          s.insert(s.end(), {segment.s_in, segment.s_out});
          cells.push_back(segment.cell);
          return true;
        },
        static_cast<ScalarOrder>(order));
  }
  const auto count = static_cast<py::ssize_t>(cells.size());
  return py::make_tuple(hand_over(std::move(t), {count, 2}), hand_over(std::move(s), {count, 2}),
                        hand_over(std::move(cells), {count}));
}

void set_lighting(RenderArguments& arguments, const std::vector<std::optional<Vector>>& lights) {
  arguments.settings.lighting.reset();
  if (lights.empty()) return;
  arguments.settings.lighting.emplace().lights.clear();
  for (const auto& direction : lights)
    arguments.settings.lighting->lights.push_back({direction, 1});
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

PYBIND11_MODULE(_plume, m) {
  m.doc() = "The compiled part of plume; see help(plume).";
  // Wrong input is a ValueError that can be told from others.
  py::register_exception<Error>(m, "Error", PyExc_ValueError).attr("__doc__") =
      "What was wrong with what was given, and what to do about it.";
  m.def("version", &version);
  m.def("color_maps", &preset_names);
  m.def("views", &view_names);

  py::class_<BorrowedMesh>(m, "Mesh")
      .def(py::init<>())
      .def("set_points",
           [](BorrowedMesh& self, const py::array& points) {
             self.mesh.points = borrow(points, "points");
           })
      .def("set_cells", &BorrowedMesh::set_cells)
      .def("set_polyhedra", &BorrowedMesh::set_polyhedra)
      .def("set_dimensions", [](BorrowedMesh& self,
                                const std::array<std::int64_t, 3>& n) { self.mesh.dimensions = n; })
      .def("set_axes", &BorrowedMesh::set_axes)
      .def("set_hidden_cells",
           [](BorrowedMesh& self, const py::array& hidden) {
             self.mesh.hidden_cells = borrow(hidden, "hidden cells");
           })
      .def("add_field", &BorrowedMesh::add_field)
      .def("remove_field",
           [](BorrowedMesh& self, const std::string& name) {
             std::erase_if(self.mesh.fields, [&](const Field& f) { return f.name == name; });
           })
      .def_property_readonly("point_count",
                             [](const BorrowedMesh& self) { return self.mesh.point_count(); })
      .def_property_readonly("cell_count",
                             [](const BorrowedMesh& self) { return self.mesh.cell_count(); })
      .def("points",
           [](const py::object& self) {
             const Array& points = self.cast<const BorrowedMesh&>().mesh.points;
             return view(points, {static_cast<py::ssize_t>(points.size() / 3), 3}, self);
           })
      .def("connectivity",
           [](const py::object& self) {
             const Array& ids = self.cast<const BorrowedMesh&>().mesh.cells.connectivity;
             return view(ids, {static_cast<py::ssize_t>(ids.size())}, self);
           })
      .def("fields", [](const py::object& self) {
        py::dict fields;
        for (const Field& field : self.cast<const BorrowedMesh&>().mesh.fields) {
          std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(field.values.size()) /
                                         field.components};
          if (field.components > 1) shape.push_back(field.components);
          fields[py::str(field.name)] = view(field.values, shape, self);
        }
        return fields;
      });

  py::class_<Camera>(m, "Camera", R"(Where a picture is taken from, in VTK's terms.

Scene.camera() makes one that sees all of a scene.)")
      .def(py::init<>())
      .def_readwrite("position", &Camera::position, "Of the eye: (x, y, z).")
      .def_readwrite("focal_point", &Camera::focal_point, "What it looks at: (x, y, z).")
      .def_readwrite("view_up", &Camera::view_up, "What is up; not along the line of sight.")
      .def_readwrite("view_angle", &Camera::view_angle,
                     "Degrees from bottom to top of the picture, in (0, 180); perspective only.")
      .def_readwrite("parallel", &Camera::parallel, "Whether it is a parallel projection.")
      .def_readwrite("parallel_scale", &Camera::parallel_scale,
                     "Half of the picture's height in world units; parallel projection only.");
  m.def("orbit", [](Camera camera, double azimuth, double elevation) {
    orbit(camera, azimuth, elevation);
    return camera;
  });
  m.def("zoom", [](Camera camera, double factor) {
    zoom(camera, factor);
    return camera;
  });

  py::class_<RenderArguments>(m, "RenderArguments")
      .def(py::init<>())
      .def("set_size",
           [](RenderArguments& self, int width, int height) {
             self.settings.width = width;
             self.settings.height = height;
           })
      .def("set_mode",
           [](RenderArguments& self, const std::string& mode) {
             self.settings.mode = chosen<Mode>({{"volume", Mode::volume},
                                                {"maximum", Mode::maximum},
                                                {"integral", Mode::integral},
                                                {"depth", Mode::depth},
                                                {"minimum", Mode::minimum},
                                                {"average", Mode::average},
                                                {"optical_depth", Mode::optical_depth},
                                                {"cell_count", Mode::cell_count}},
                                               mode, "mode");
           })
      .def("set_order",
           [](RenderArguments& self, int order) {
             if (order < 1 || order > 3)
               throw Error("order " + std::to_string(order) + ": 1, 2 or 3");
             self.settings.order = static_cast<ScalarOrder>(order);
           })
      .def("set_lights", &set_lighting)
      .def("add_clip_plane",
           [](RenderArguments& self, const Vector& point, const Vector& normal) {
             self.settings.clip_planes.push_back({point, normal});
           })
      .def_property(
          "threads", [](const RenderArguments& self) { return self.settings.threads; },
          [](RenderArguments& self, int threads) { self.settings.threads = threads; })
      .def_property(
          "early_termination",
          [](const RenderArguments& self) { return self.settings.early_termination; },
          [](RenderArguments& self, double share) { self.settings.early_termination = share; })
      .def_property(
          "channels", [](const RenderArguments& self) { return self.settings.channels; },
          [](RenderArguments& self, std::vector<std::string> channels) {
            self.settings.channels = std::move(channels);
          })
      .def_readwrite("progress", &RenderArguments::progress);

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
