#include "plucker_walker.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "plume/mesh/error.h"

namespace plume::bench {

PluckerMesh make_plucker_mesh(TetAdjacency adjacency) {
  if (adjacency.cells.size() >= kNone / 4)
    throw Error("the Plücker baseline numbers cells with 30 bits; the mesh has " +
                std::to_string(adjacency.cells.size()) + " cells");
  PluckerMesh mesh;
  mesh.frame = adjacency.frame;
  mesh.points = std::move(adjacency.points);
  mesh.cells.resize(adjacency.cells.size());
  const auto& cells = adjacency.cells;
  auto linked = [&](const TetAdjacency::Cell& cell) {
    PluckerMesh::Cell record{cell.points, {}};
    for (std::size_t f = 0; f < 4; ++f) {
      const std::uint32_t neighbor = cell.neighbors[f];
      record.neighbors[f] = kNone;
      if (neighbor == kNone) continue;
      // The neighbour's point that is none of the common face's.
      const auto& points = cells[neighbor].points;
      for (std::uint32_t back = 0; back < 4; ++back) {
        const auto same = std::find(cell.points.begin(), cell.points.end(), points[back]);
        if (same == cell.points.end() || *same == cell.points[f])
          record.neighbors[f] = 4 * neighbor + back;
      }
    }
    return record;
  };
#if FACE == 3
  for (auto& c : adjacency.cells) for(int i=0;i<4;i++)for(int j=0;j<3;j++) if(c.points[j]>c.points[j+1]){std::swap(c.points[j],c.points[j+1]);std::swap(c.neighbors[j],c.neighbors[j+1]);}
#endif
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) mesh.cells[i] = linked(cells[i]);
  });
  return mesh;
}

PluckerRay::PluckerRay(const Ray& world, const LocalFrame& frame) {
  double along = 0, length2 = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    along += (frame.center[a] - world.origin[a]) * world.direction[a];
    length2 += world.direction[a] * world.direction[a];
  }
  along /= length2;
  double oo[3];
  for (std::size_t a = 0; a < 3; ++a) {
    oo[a] = ((world.origin[a] - frame.center[a]) + along * world.direction[a]) * frame.scale;
    d[a] = static_cast<float>(world.direction[a]);
    o[a] = static_cast<float>(oo[a]);
  }
  const auto& v = world.direction;
  q[0] = static_cast<float>(v[1] * oo[2] - v[2] * oo[1]);
  q[1] = static_cast<float>(v[2] * oo[0] - v[0] * oo[2]);
  q[2] = static_cast<float>(v[0] * oo[1] - v[1] * oo[0]);
  t_per_length = static_cast<float>(1 / (frame.scale * length2));
  t_offset = static_cast<float>(along);
}

}  // namespace plume::bench
