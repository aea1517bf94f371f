#include "plume/tests/bench/plucker_walker.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <string>

#include "plume/mesh/error.h"

namespace plume::bench {
namespace {

// Which of the neighbour's points none of the common face is; the face leaves out `apex` of `cell`.
std::uint32_t point_across(const TetAdjacency::Cell& cell, std::uint32_t apex,
                           const TetAdjacency::Cell& neighbor) {
  for (std::uint32_t i = 0; i < 3; ++i) {
    const auto same = std::find(cell.points.begin(), cell.points.end(), neighbor.points[i]);
    if (same == cell.points.end() || *same == apex) return i;
  }
  return 3;
}

}  // namespace

PluckerMesh make_plucker_mesh(TetAdjacency adjacency) {
  const auto& cells = adjacency.cells;
  if (cells.size() >= kNone / 4)
    throw Error("the Plücker baseline numbers cells with 30 bits; this mesh has " +
                std::to_string(cells.size()) + " cells");
  PluckerMesh mesh;
  mesh.frame = adjacency.frame;
  mesh.points = std::move(adjacency.points);
  mesh.cells.resize(cells.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const TetAdjacency::Cell& cell = cells[i];
      mesh.cells[i].points = cell.points;
      for (std::size_t f = 0; f < 4; ++f) {
        const std::uint32_t neighbor = cell.neighbors[f];
        mesh.cells[i].neighbors[f] =
            neighbor == kNone ? kNone
                              : 4 * neighbor + point_across(cell, cell.points[f], cells[neighbor]);
      }
    }
  });
  return mesh;
}

PluckerRay::PluckerRay(const Ray& ray, const LocalFrame& frame) {
  double along = 0, length2 = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    along += (frame.center[a] - ray.origin[a]) * ray.direction[a];
    length2 += ray.direction[a] * ray.direction[a];
  }
  along /= length2;
  for (std::size_t a = 0; a < 3; ++a) {
    d[a] = static_cast<float>(ray.direction[a]);
    o[a] = static_cast<float>(((ray.origin[a] - frame.center[a]) + along * ray.direction[a]) *
                              frame.scale);
  }
  t_offset = static_cast<float>(along);
  t_per_length = static_cast<float>(1 / (frame.scale * length2));
}

}  // namespace plume::bench
