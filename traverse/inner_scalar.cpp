#include "plume/traverse/inner_scalar.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "plume/mesh/cell_shape.h"

namespace plume {
namespace {

template <class Map>
bool scalars_of(const Map& map, std::span<const Place> places, float* scalars) {
  Place start = map.center();
  for (const Place& place : places) {
    auto found = invert(map, place, start);
    // From where the ray was before, unless that is too far.
    if (!found) found = invert(map, place, map.center());
    if (!found) return false;
    *scalars++ = static_cast<float>(map.at(*found)[3]);
    start = *found;
  }
  return true;
}

PointValue mean(std::span<const PointValue> points) {
  PointValue sum{};
  for (const PointValue& p : points) add_multiple(sum, 1, p);
  for (double& x : sum) x /= static_cast<double>(points.size());
  return sum;
}

/// A cell as pyramids over its quadrilaterals and tetrahedra over the triangles of its other faces,
/// all with the cell's centre as their apex.
class CentredParts {
 public:
  CentredParts(const WalkableCells& mesh, std::uint32_t cell) : mesh_(mesh), cell_(cell) {
    std::vector<std::uint32_t> ids;
    for (const std::uint32_t face : mesh.faces_of(cell))
      ids.insert(ids.end(), mesh.loop(face).begin(), mesh.loop(face).end());
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    load(ids);
    center_ = mean(loop_);
  }

  /// From the first part that holds the place, else from the one that it is least outside of.
  std::optional<double> scalar(const Place& place) {
    Best best;
    for (const std::uint32_t face : mesh_.faces_of(cell_)) {
      load(mesh_.loop(face));
      if (loop_.size() == 4)
        try_pyramid(place, best);
      else
        try_tetrahedra(place, best);
      if (best.depth >= 0) break;
    }
    if (!(best.depth >= -kFarthestOutside)) return std::nullopt;
    return best.scalar;
  }

 private:
  struct Best {
    double depth = -std::numeric_limits<double>::infinity();
    double scalar = 0;
    void take(double other_depth, double other_scalar) {
      if (other_depth > depth) *this = {other_depth, other_scalar};
    }
  };

  void load(std::span<const std::uint32_t> ids) {
    loop_.clear();
    for (const std::uint32_t id : ids) loop_.push_back(point_value(mesh_.points[id]));
  }

  void try_pyramid(const Place& place, Best& best) const {
    const PyramidMap map({loop_[0], loop_[1], loop_[2], loop_[3]}, center_);
    if (const auto found = invert(map, place, map.center()))
      best.take(map.depth(*found), map.at(*found)[3]);
  }

  // The face's fan around its own centre; a triangle needs none.
  void try_tetrahedra(const Place& place, Best& best) const {
    if (loop_.size() == 3) return try_tetrahedron(loop_[0], loop_[1], loop_[2], place, best);
    const PointValue middle = mean(loop_);
    for (std::size_t i = 0; i < loop_.size(); ++i)
      try_tetrahedron(middle, loop_[i], loop_[(i + 1) % loop_.size()], place, best);
  }

  void try_tetrahedron(const PointValue& a, const PointValue& b, const PointValue& c,
                       const Place& place, Best& best) const {
    const std::array<PointValue, 3> edges{a - center_, b - center_, c - center_};
    const InverseJacobian inverse(edges);
    if (!inverse.is_regular()) return;
    const auto [u, v, w] = inverse.step(center_, place);
    best.take(std::fmin(std::fmin(u, v), std::fmin(w, 1 - u - v - w)),
              center_[3] + u * edges[0][3] + v * edges[1][3] + w * edges[2][3]);
  }

  const WalkableCells& mesh_;
  std::uint32_t cell_;
  PointValue center_{};
  std::vector<PointValue> loop_;
};

}  // namespace

bool scalars_inside(const WalkableGrid& mesh, std::uint32_t cell, std::span<const Place> places,
                    float* scalars) {
  const std::uint32_t ni = mesh.dimensions[0], nij = ni * mesh.dimensions[1];
  const WalkablePoint* const first = &mesh.points[mesh.first_point(cell)];
  std::array<WalkablePoint, 8> corners;
  for (std::uint32_t c = 0; c < 8; ++c)
    corners[c] = first[(c & 1) + (c >> 1 & 1) * ni + (c >> 2) * nij];
  return scalars_of(MultilinearMap::hexahedron(corners), places, scalars);
}

bool scalars_inside(const WalkableCells& mesh, std::uint32_t cell, std::span<const Place> places,
                    float* scalars) {
  const CellShape shape = shape_of(mesh, cell);
  auto corner = [&](std::size_t i) -> const WalkablePoint& {
    return mesh.points[shape.corners[i]];
  };
  switch (shape.type) {
    case CellType::tetrahedron:
      return false;
    case CellType::hexahedron:
      // VTK goes around the faces t = 0 and t = 1.
      return scalars_of(MultilinearMap::hexahedron({corner(0), corner(1), corner(3), corner(2),
                                                    corner(4), corner(5), corner(7), corner(6)}),
                        places, scalars);
    case CellType::wedge:
      return scalars_of(
          MultilinearMap::wedge({corner(0), corner(1), corner(2), corner(3), corner(4), corner(5)}),
          places, scalars);
    case CellType::pyramid:
      return scalars_of(PyramidMap({point_value(corner(0)), point_value(corner(1)),
                                    point_value(corner(2)), point_value(corner(3))},
                                   point_value(corner(4))),
                        places, scalars);
    default:
      break;
  }
  CentredParts parts(mesh, cell);
  for (const Place& place : places) {
    const auto scalar = parts.scalar(place);
    if (!scalar) return false;
    *scalars++ = static_cast<float>(*scalar);
  }
  return true;
}

}  // namespace plume
