#include "plume/mesh/boundary_clusters.h"

#include <algorithm>

namespace plume {

ClusterTree make_boundary_clusters(const WalkableTets& mesh) {
  const std::size_t faces = mesh.boundary.size();
  return make_cluster_tree((faces + kLeafFaces - 1) / kLeafFaces, [&](std::size_t leaf) {
    Cluster cluster;
    cluster.least = cluster.greatest = 0;
    const std::size_t begin = kLeafFaces * leaf;
    for (std::size_t f = begin; f < std::min(faces, begin + kLeafFaces); ++f)
      for (const std::uint32_t point : mesh.boundary[f].loop)
        cluster.add(mesh.points[point].position);
    return cluster;
  });
}

}  // namespace plume
