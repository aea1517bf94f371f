/// The gradient at any place of a walkable mesh: the normals of isosurfaces.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "plume/mesh/walkable_cells.h"
#include "plume/mesh/walkable_grid.h"
#include "plume/mesh/walkable_rectilinear.h"
#include "plume/mesh/walkable_tets.h"

namespace plume {

/// Gradients at a mesh's points (mesh/gradients.h), interpolated inside of its cells as the scalar
/// is at order 3 (traverse/inner_scalar.h): linearly in tetrahedra, by the isoparametric map in
/// hexahedra, wedges and pyramids. So they are continuous across faces, which the gradient of the
/// interpolated scalar is not, and surfaces look smooth. Exact for linear fields. 12 bytes a
/// point.
///
/// Where the interpolation has no answer (cells without volume, gradients that are NaN), the mean
/// of the cell's points, weighted by 1 / distance^2, of those that have a gradient; in a
/// rectilinear grid, the trilinear weights of those. NaN where none has.
class GradientField {
 public:
  /// `of_points` as from point_gradients() of the mesh that the walkable one was made from; of
  /// tetrahedra and cells, with point_numbers kept.
  GradientField(const WalkableTets& walkable, std::vector<float> of_points);
  GradientField(const WalkableCells& walkable, std::vector<float> of_points);
  GradientField(const WalkableGrid& walkable, std::vector<float> of_points);
  GradientField(const WalkableRectilinear& walkable, std::vector<float> of_points);

  /// Replaces the gradients by those of another field of the same mesh.
  void put(const WalkableTets& walkable, std::vector<float> of_points);
  void put(const WalkableCells& walkable, std::vector<float> of_points);
  void put(const WalkableGrid& walkable, std::vector<float> of_points);
  void put(const WalkableRectilinear& walkable, std::vector<float> of_points);

  /// In units of the scalar per world length, at a place of that cell, in world coordinates.
  using Vector = std::array<double, 3>;
  Vector at(const WalkableTets& walkable, std::uint32_t cell, const Vector& place) const;
  Vector at(const WalkableCells& walkable, std::uint32_t cell, const Vector& place) const;
  Vector at(const WalkableGrid& walkable, std::uint32_t cell, const Vector& place) const;
  Vector at(const WalkableRectilinear& walkable, std::uint32_t cell, const Vector& place) const;

  std::size_t bytes() const;

 private:
  Vector value(std::uint32_t point) const {
    return {values_[3 * std::size_t{point}], values_[3 * std::size_t{point} + 1],
            values_[3 * std::size_t{point} + 2]};
  }
  Vector weighted(std::span<const std::uint32_t> points, std::span<const double> weights) const;
  template <class Walkable>
  Vector in_tetrahedron(const Walkable& walkable, std::span<const std::uint32_t> points,
                        const Vector& local) const;
  template <class Walkable>
  Vector by_distance(const Walkable& walkable, std::span<const std::uint32_t> points,
                     const Vector& local) const;

  std::vector<float> values_;  // 3 a point of the walkable mesh
};

}  // namespace plume
