#include "plume/mesh/cell_shape.h"

#include <algorithm>
#include <optional>
#include <span>

#include "plume/mesh/cell_faces.h"

namespace plume {
namespace {

using Loop = std::span<const std::uint32_t>;

/// A cell's faces: at most six, or it is none of the types that are looked for.
struct FewFaces {
  std::array<Loop, 6> loops;
  std::size_t size = 0;

  const Loop* first_of(std::size_t points) const {
    for (std::size_t f = 0; f < size; ++f)
      if (loops[f].size() == points) return &loops[f];
    return nullptr;
  }
};

// The points that come next to a and to b in the face other than `base` that has the edge a-b.
std::optional<std::array<std::uint32_t, 2>> beyond(const FewFaces& faces, const Loop* base,
                                                   std::uint32_t a, std::uint32_t b) {
  for (std::size_t f = 0; f < faces.size; ++f) {
    const Loop loop = faces.loops[f];
    if (&faces.loops[f] == base) continue;
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t before = loop[(i + n - 1) % n], after = loop[(i + 2) % n];
      if (loop[i] == a && loop[(i + 1) % n] == b) return {{before, after}};
      if (loop[i] == b && loop[(i + 1) % n] == a) return {{after, before}};
    }
  }
  return std::nullopt;
}

// Whether a loop goes around these corners, in either direction.
bool goes_around(Loop loop, const FaceLoop& wanted, const std::array<std::uint32_t, 8>& corners) {
  const std::size_t n = loop.size();
  if (static_cast<std::size_t>(wanted.size) != n) return false;
  auto corner = [&](std::size_t i) { return corners[static_cast<std::size_t>(wanted.points[i])]; };
  const auto start =
      static_cast<std::size_t>(std::find(loop.begin(), loop.end(), corner(0)) - loop.begin());
  if (start == n) return false;
  bool forward = true, backward = true;
  for (std::size_t i = 1; i < n; ++i) {
    forward = forward && loop[(start + i) % n] == corner(i);
    backward = backward && loop[(start + n - i) % n] == corner(i);
  }
  return forward || backward;
}

// Whether the faces are those of the type with these corners, all of them different.
bool fits(const FewFaces& faces, const CellShape& shape) {
  const auto end = shape.corners.begin() + points_per_cell(shape.type);
  for (auto c = shape.corners.begin(); c != end; ++c)
    if (std::find(shape.corners.begin(), c, *c) != c) return false;
  for (const FaceLoop& wanted : faces_of(shape.type))
    if (std::none_of(faces.loops.begin(),
                     faces.loops.begin() + static_cast<std::ptrdiff_t>(faces.size),
                     [&](Loop loop) { return goes_around(loop, wanted, shape.corners); }))
      return false;
  return true;
}

// The corners that two faces and the edges between them suggest.
std::optional<CellShape> suggested(const FewFaces& faces) {
  const Loop* const triangle = faces.first_of(3);
  const Loop* const quadrilateral = faces.first_of(4);
  CellShape shape;
  auto& c = shape.corners;
  if (faces.size == 6 && triangle == nullptr && quadrilateral != nullptr) {
    shape.type = CellType::hexahedron;
    std::copy_n(quadrilateral->begin(), 4, c.begin());
    for (const std::size_t i : {0, 2}) {
      const auto next = beyond(faces, quadrilateral, c[i], c[i + 1]);
      if (!next) return std::nullopt;
      c[i + 4] = (*next)[0];
      c[i + 5] = (*next)[1];
    }
    return shape;
  }
  if (triangle == nullptr || faces.size > 5) return std::nullopt;
  if (quadrilateral != nullptr) {
    // A wedge stands on a triangle, a pyramid on its quadrilateral.
    const auto triangles = std::count_if(faces.loops.begin(), faces.loops.begin() + 5,
                                         [](Loop loop) { return loop.size() == 3; });
    const Loop* const base = triangles == 2 ? triangle : quadrilateral;
    shape.type = triangles == 2 ? CellType::wedge : CellType::pyramid;
    std::copy(base->begin(), base->end(), c.begin());
    const auto first = beyond(faces, base, c[0], c[1]);
    const auto second = beyond(faces, base, c[1], c[2]);
    if (!first || !second) return std::nullopt;
    const std::size_t top = base->size();
    c[top] = (*first)[0];
    if (shape.type == CellType::wedge) {
      c[top + 1] = (*first)[1];
      c[top + 2] = (*second)[1];
    }
    return shape;
  }
  shape.type = CellType::tetrahedron;
  std::copy_n(triangle->begin(), 3, c.begin());
  const auto apex = beyond(faces, triangle, c[0], c[1]);
  if (!apex) return std::nullopt;
  c[3] = (*apex)[0];
  return shape;
}

}  // namespace

CellShape shape_of(const WalkableCells& mesh, std::uint32_t cell) {
  const auto numbers = mesh.faces_of(cell);
  FewFaces faces;
  if (numbers.size() < 4 || numbers.size() > faces.loops.size()) return {};
  for (const std::uint32_t face : numbers) {
    faces.loops[faces.size++] = mesh.loop(face);
    if (mesh.loop(face).size() > 4) return {};
  }
  const auto shape = suggested(faces);
  if (!shape || faces.size != faces_of(shape->type).size() || !fits(faces, *shape)) return {};
  return *shape;
}

}  // namespace plume
