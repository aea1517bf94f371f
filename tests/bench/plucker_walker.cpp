#include "plume/tests/bench/plucker_walker.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <string>

#include "plume/mesh/error.h"
#include "plume/mesh/huge_pages.h"

namespace plume::bench {

PluckerMesh make_plucker_mesh(const Mesh& source, TetAdjacency adjacency) {
  const auto& cells = adjacency.cells;
  if (cells.size() >= kNone / 4)
    throw Error("the Plücker baseline numbers cells with 30 bits; this mesh has " +
                std::to_string(cells.size()) + " cells");
  PluckerMesh mesh;
  mesh.frame = adjacency.frame;
  mesh.points = std::move(adjacency.points);
  // As for our own cells: pages are no part of the method.
  resize_in_huge_pages(mesh.cells, cells.size());
  const auto for_each_cell = [&](const auto& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 4096),
                      [&](const auto& range) {
                        for (std::size_t c = range.begin(); c != range.end(); ++c) body(c);
                      });
  };
  source.cells.connectivity.visit([&](auto ids) {
    for_each_cell([&](std::size_t c) {
      for (std::size_t v = 0; v < 4; ++v)
        mesh.cells[c].points[v] =
            adjacency
                .numbers[static_cast<std::size_t>(ids[4 * std::size_t{adjacency.original[c]} + v])];
    });
  });
  // Where a point is in a cell's list.
  const auto place = [&](std::size_t c, std::uint32_t point) {
    const auto& points = mesh.cells[c].points;
    return static_cast<std::size_t>(std::find(points.begin(), points.end(), point) -
                                    points.begin());
  };
  for_each_cell([&](std::size_t c) {
    for (std::size_t face = 4 * c; face < 4 * c + 4; ++face) {
      const std::uint32_t partner = adjacency.partner(face);
      mesh.cells[c].neighbors[place(c, adjacency.point(face))] =
          partner == kNone
              ? kNone
              : partner / 4 * 4 +
                    static_cast<std::uint32_t>(place(partner / 4, adjacency.point(partner)));
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
