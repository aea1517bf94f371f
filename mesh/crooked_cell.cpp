#include "plume/mesh/crooked_cell.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "plume/mesh/cell_hierarchy.h"
#include "plume/mesh/corner_cells.h"

namespace plume {
namespace {

struct Vector {
  float x, y, z;
};
Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
float dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vector position_of(const WalkablePoint& point) {
  return {point.position[0], point.position[1], point.position[2]};
}

// Whether the plane through a point whose normal that is, times any length, leaves the origin
// behind it, at a distance.
bool faces_away(const Vector& normal, const Vector& point) {
  const float height = dot(normal, point);
  return height > 0 && height * height >= kLeastWidth * kLeastWidth * dot(normal, normal);
}

bool triangle_faces_away(const Vector& a, const Vector& b, const Vector& c) {
  return faces_away(cross(b - a, c - a), a);
}

// Counterclockwise from outside; positions are relative to the middle of the cell.
bool quad_faces_away(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  const Vector along[2] = {b - a, c - d}, up[2] = {d - a, c - b};
  bool away = true;
  for (const Vector& u : along)
    for (const Vector& v : up) {
      const Vector normal = cross(u, v);
      for (const Vector* corner : {&a, &b, &c, &d}) away = away && faces_away(normal, *corner);
    }
  return away;
}

}  // namespace

bool is_crooked(const WalkableGrid& mesh, std::uint32_t cell) {
  const std::uint32_t first = mesh.first_point(cell), row = mesh.dimensions[0];
  const std::uint32_t plane = row * mesh.dimensions[1];
  std::array<Vector, 8> corner;
  Vector middle{0, 0, 0};
  for (std::uint32_t c = 0; c < 8; ++c) {
    corner[c] = position_of(mesh.points[first + (c & 1) + (c >> 1 & 1) * row + (c >> 2) * plane]);
    middle = {middle.x + corner[c].x / 8, middle.y + corner[c].y / 8, middle.z + corner[c].z / 8};
  }
  for (Vector& c : corner) c = c - middle;
  for (std::size_t face = 0; face < 6; ++face) {
    const auto& loop = kCornerLoop[face];
    const Vector &a = corner[loop[0]], &c = corner[loop[2]];
    const bool outwards = (face % 2 == 1) != mesh.left_handed;
    const Vector& b = corner[loop[outwards ? 1 : 3]];
    const Vector& d = corner[loop[outwards ? 3 : 1]];
    if (!quad_faces_away(a, b, c, d)) return true;
  }
  return false;
}

bool is_crooked(const WalkableCells& mesh, std::uint32_t cell) {
  Vector middle{0, 0, 0};
  float count = 0;
  for (const std::uint32_t face : mesh.faces_of(cell))
    for (const std::uint32_t point : mesh.loop(face)) {
      const Vector p = position_of(mesh.points[point]);
      middle = {middle.x + p.x, middle.y + p.y, middle.z + p.z};
      ++count;
    }
  middle = {middle.x / count, middle.y / count, middle.z / count};
  for (const std::uint32_t face : mesh.faces_of(cell)) {
    const auto loop = mesh.loop(face);
    // Seen from outside of the face's owner.
    const bool outwards = mesh.face_sides[face].owner == cell;
    auto corner = [&](std::size_t i) {
      return position_of(mesh.points[loop[outwards ? i : loop.size() - 1 - i]]) - middle;
    };
    if (loop.size() == 3 && !triangle_faces_away(corner(0), corner(1), corner(2))) return true;
    if (loop.size() == 4 && !quad_faces_away(corner(0), corner(1), corner(2), corner(3)))
      return true;
    if (loop.size() <= 4) continue;
    Vector center{0, 0, 0};
    const float share = 1 / static_cast<float>(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector p = corner(i);
      center = {center.x + share * p.x, center.y + share * p.y, center.z + share * p.z};
    }
    for (std::size_t i = 0; i < loop.size(); ++i)
      if (!triangle_faces_away(center, corner(i), corner((i + 1) % loop.size()))) return true;
  }
  return false;
}

}  // namespace plume
