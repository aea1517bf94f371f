#include <array>
#include <cstdlib>
#include <unordered_map>

#include "plume/datasets/families.h"
#include "plume/datasets/grid.h"

namespace plume::datasets {
namespace {

using Lattice = std::array<int, 3>;

/// Numbers the lattice points of the octahedron |a| + |b| + |c| <= size as they are met, and puts
/// each on the sphere of radius (|a| + |b| + |c|) / size, in its own direction.
class BallPoints {
 public:
  explicit BallPoints(int size) : size_(size) {}

  std::int32_t id(const Lattice& at) {
    const auto next = static_cast<std::int32_t>(coordinates.size() / 3);
    const auto [found, is_new] = ids_.try_emplace(key(at), next);
    if (is_new) {
      const double shell = std::abs(at[0]) + std::abs(at[1]) + std::abs(at[2]);
      const double length = distance({1.0 * at[0], 1.0 * at[1], 1.0 * at[2]}, {0, 0, 0});
      const double scale = length > 0 ? shell / (length * size_) : 0;
      for (int a : at) coordinates.push_back(scale * a);
    }
    return found->second;
  }

  std::vector<double> coordinates;

 private:
  std::int64_t key(const Lattice& at) const {
    const std::int64_t n = 2 * static_cast<std::int64_t>(size_) + 1;
    return (at[0] + size_) + n * ((at[1] + size_) + n * (at[2] + size_));
  }

  int size_;
  std::unordered_map<std::int64_t, std::int32_t> ids_;
};

/// The six paths along the axes that make up a cube's tetrahedra, the even ones first.
constexpr std::array<std::array<std::size_t, 3>, 6> paths{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};

/// Calls f with the four corners of each of the size^3 tetrahedra that the simplex
/// size >= x >= y >= z >= 0 is cut into: those of the cubic lattice (Freudenthal) that lie within
/// it. Their orientation is positive.
template <class F>
void for_each_simplex(int size, F&& f) {
  const auto within = [&](const Lattice& p) {
    return size >= p[0] && p[0] >= p[1] && p[1] >= p[2] && p[2] >= 0;
  };
  for (int x = 0; x < size; ++x) {
    for (int y = 0; y <= x; ++y) {
      for (int z = 0; z <= y; ++z) {
        for (std::size_t path = 0; path < paths.size(); ++path) {
          std::array<Lattice, 4> corners{};
          corners[0] = {x, y, z};
          for (std::size_t step = 0; step < 3; ++step) {
            corners[step + 1] = corners[step];
            ++corners[step + 1][paths[path][step]];
          }
          if (!within(corners[1]) || !within(corners[2]) || !within(corners[3])) continue;
          if (path >= 3) std::swap(corners[1], corners[2]);
          f(corners);
        }
      }
    }
  }
}

}  // namespace

Mesh ball_tetrahedra(const GenerateOptions& options) {
  const int size = size_or(options, 24);
  const double n = size;
  require_int32_ids((2 * n + 1) * (2 * n * n + 2 * n + 3) / 3, size);

  BallPoints points(size);
  std::vector<std::int32_t> connectivity;
  // The eight octants mirror each other, so their tetrahedra match on the planes between them.
  for (int octant = 0; octant < 8; ++octant) {
    const Lattice sign{octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1};
    const bool mirrored = sign[0] * sign[1] * sign[2] < 0;
    for_each_simplex(size, [&](const std::array<Lattice, 4>& corners) {
      std::array<std::int32_t, 4> ids{};
      for (std::size_t c = 0; c < 4; ++c) {
        // (x, y, z) -> (x - y, y - z, z) takes the simplex to the octant a + b + c <= size.
        const auto& p = corners[c];
        ids[c] = points.id({sign[0] * (p[0] - p[1]), sign[1] * (p[1] - p[2]), sign[2] * p[2]});
      }
      if (mirrored) std::swap(ids[1], ids[2]);
      connectivity.insert(connectivity.end(), ids.begin(), ids.end());
    });
  }

  Mesh mesh;
  mesh.points = Array::own(std::move(points.coordinates));
  mesh.cells = cells_of(CellType::tetrahedron, std::move(connectivity));
  add_box_fields(mesh, {0, 0, 0});
  return mesh;
}

}  // namespace plume::datasets
