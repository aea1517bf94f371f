#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"

namespace plume::python {
namespace {

namespace py = pybind11;

void set_cells(BorrowedMesh& self, const py::array& types, const py::object& offsets,
               const py::array& connectivity) {
  self.mesh.cells.types = borrow(types, "types");
  if (!offsets.is_none()) self.mesh.cells.offsets = borrow(offsets.cast<py::array>(), "offsets");
  self.mesh.cells.connectivity = borrow(connectivity, "connectivity");
}

void set_polyhedra(BorrowedMesh& self, const py::array& faces, const py::array& locations) {
  self.mesh.cells.polyhedron_faces = borrow(faces, "polyhedron faces");
  self.mesh.cells.polyhedron_locations = borrow(locations, "polyhedron locations");
}

void set_axes(BorrowedMesh& self, const std::array<py::array, 3>& axes) {
  for (std::size_t a = 0; a < 3; ++a) {
    self.mesh.axes[a] = borrow(axes[a], std::string("axis ") + "xyz"[a]);
    self.mesh.dimensions[a] = static_cast<std::int64_t>(self.mesh.axes[a].size());
  }
}

void add_field(BorrowedMesh& self, const std::string& name, bool on_points, int components,
               const py::array& values) {
  self.mesh.fields.push_back({name, on_points ? Association::point : Association::cell, components,
                              borrow(values, "field '" + name + "'")});
}

}  // namespace

void bind_mesh(py::module_& m) {
  py::class_<BorrowedMesh>(m, "Mesh")
      .def(py::init<>())
      .def("set_points",
           [](BorrowedMesh& self, const py::array& points) {
             self.mesh.points = borrow(points, "points");
           })
      .def("set_cells", &set_cells)
      .def("set_polyhedra", &set_polyhedra)
      .def("set_dimensions", [](BorrowedMesh& self,
                                const std::array<std::int64_t, 3>& n) { self.mesh.dimensions = n; })
      .def("set_axes", &set_axes)
      .def("set_hidden_cells",
           [](BorrowedMesh& self, const py::array& hidden) {
             self.mesh.hidden_cells = borrow(hidden, "hidden cells");
           })
      .def("add_field", &add_field)
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
}

}  // namespace plume::python
