/// Whether tetrahedra are a Delaunay tetrahedralization, decided by CGAL's exact predicates; and
/// volumes in rational numbers.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace plume::reference {

using Tetrahedra = std::vector<std::array<std::uint32_t, 4>>;
using Points = std::vector<std::array<double, 3>>;

/// Tetrahedra whose volume is not above zero.
std::size_t count_not_positive(const Points& points, const Tetrahedra& tetrahedra);

/// Faces with more than two tetrahedra, or with two on the same side.
std::size_t count_bad_faces(const Points& points, const Tetrahedra& tetrahedra);

/// Faces between two tetrahedra of which the one's fourth point is strictly inside of the other's
/// circumscribed sphere. Where there is none, and the tetrahedra fill a convex region, no point is
/// inside of any sphere (Delaunay, 1934).
std::size_t count_not_delaunay(const Points& points, const Tetrahedra& tetrahedra);

/// Six times the sum of the signed volumes, as an exact fraction.
std::string six_volumes(const Points& points, const Tetrahedra& tetrahedra);

}  // namespace plume::reference
