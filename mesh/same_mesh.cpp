#include "plume/mesh/same_mesh.h"

#include <cstring>

namespace plume {
namespace {

bool same(const Array& a, const Array& b) {
  if (a.size() != b.size()) return false;
  if (a.empty()) return true;  // of whatever type
  if (a.type() != b.type()) return false;
  return a.data() == b.data() || std::memcmp(a.data(), b.data(), a.size() * a.value_bytes()) == 0;
}

bool same(const Cells& a, const Cells& b) {
  return same(a.types, b.types) && same(a.offsets, b.offsets) &&
         same(a.connectivity, b.connectivity) &&
         same(a.polyhedron_locations, b.polyhedron_locations) &&
         same(a.polyhedron_faces, b.polyhedron_faces);
}

}  // namespace

bool same_points_and_cells(const Mesh& a, const Mesh& b) {
  return a.dimensions == b.dimensions && same(a.points, b.points) && same(a.axes[0], b.axes[0]) &&
         same(a.axes[1], b.axes[1]) && same(a.axes[2], b.axes[2]) &&
         same(a.hidden_cells, b.hidden_cells) && same(a.cells, b.cells);
}

}  // namespace plume
