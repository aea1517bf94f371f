#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"

namespace plume::python {
namespace {

namespace py = pybind11;

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

void set_lighting(RenderArguments& arguments, const std::vector<std::optional<Vector>>& lights) {
  arguments.settings.lighting.reset();
  if (lights.empty()) return;
  arguments.settings.lighting.emplace().lights.clear();
  for (const auto& direction : lights)
    arguments.settings.lighting->lights.push_back({direction, 1});
}

}  // namespace

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

void bind_render(py::module_& m) {
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
      .def("set_tolerance",
           [](RenderArguments& self, double max_error) {
             self.settings.tolerance.emplace().max_error = max_error;
           })
      .def_property(
          "channels", [](const RenderArguments& self) { return self.settings.channels; },
          [](RenderArguments& self, std::vector<std::string> channels) {
            self.settings.channels = std::move(channels);
          })
      .def_readwrite("progress", &RenderArguments::progress);
}

}  // namespace plume::python
