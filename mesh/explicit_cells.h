/// Reading the cells of a mesh one by one, whatever the arrays they are in.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "plume/mesh/mesh.h"

namespace plume {

/// A mesh's cells with ids of one width, ready to be read in a loop. Requires check_structure().
/// A grid's cells come as hexahedra; hidden ones are left out of nothing: ask `hidden`.
class CellReader {
 public:
  explicit CellReader(const Mesh& mesh);

  std::size_t size() const { return size_; }
  CellType type(std::size_t cell) const;
  bool hidden(std::size_t cell) const;

  /// The cell's points in VTK's order, in `ids`; the points of a polyhedron in no stated order.
  void points(std::size_t cell, std::vector<std::uint32_t>& ids) const;

  /// The cell's faces: sizes in `sizes`, point ids one after the other in `ids`. Loops of the types
  /// with a fixed number of points are seen from outside; a polyhedron's are as the file has them.
  void faces(std::size_t cell, std::vector<std::uint32_t>& sizes,
             std::vector<std::uint32_t>& ids) const;

 private:
  std::uint32_t id(std::size_t i) const;

  const Mesh& mesh_;
  std::size_t size_;
};

/// World coordinates of a point.
std::array<double, 3> point_at(const Mesh& mesh, std::size_t point);

/// Signed volume of a cell from its faces, seen from outside: the sum of the tetrahedra between a
/// point of the cell and the triangles of each face's fan. Positive for VTK's positive orientation.
double signed_volume(const Mesh& mesh, std::span<const std::uint32_t> sizes,
                     std::span<const std::uint32_t> ids);

}  // namespace plume
