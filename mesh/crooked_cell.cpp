#include "plume/mesh/crooked_cell.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

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

// Planes behind which the origin lies, each by a normal of any length and a point of it.
class Planes {
 public:
  void add(const Vector& normal, const Vector& point) {
    least_ = std::min(least_, dot(normal, point));
    longest_ = std::max(longest_, dot(normal, normal));
  }
  // Whether the origin is behind all of them, at a distance.
  bool face_away() const {
    return least_ > 0 && least_ * least_ >= kLeastWidth * kLeastWidth * longest_;
  }

 private:
  float least_ = std::numeric_limits<float>::infinity(), longest_ = 0;
};

bool triangle_faces_away(const Vector& a, const Vector& b, const Vector& c) {
  Planes planes;
  planes.add(cross(b - a, c - a), a);
  return planes.face_away();
}

// Counterclockwise from outside; positions are relative to the middle of the cell. A bilinear
// patch's normal P_u x P_v is bilinear in u and v, and so is its product with P: the quadratic
// terms vanish, as P is P(0, v) + u P_u(v), and P(u, 0) + v P_v(u). So the corners say it for all
// of it.
bool quad_faces_away(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  const Vector ab = b - a, bc = c - b, dc = c - d, ad = d - a;
  Planes planes;
  planes.add(cross(ab, ad), a);
  planes.add(cross(ab, bc), b);
  planes.add(cross(dc, bc), c);
  planes.add(cross(dc, ad), d);
  return planes.face_away();
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
