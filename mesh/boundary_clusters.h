/// A tree over the faces at a mesh's boundary.
#pragma once

#include <cstddef>
#include <cstdint>

#include "plume/mesh/cluster_tree.h"
#include "plume/mesh/walkable_tets.h"

namespace plume {

/// Faces of a leaf, which follow each other in the mesh's list.
inline constexpr std::size_t kLeafFaces = 16;

/// Boxes alone: their ranges mean nothing. About 2.3 bytes a face at the boundary.
ClusterTree make_boundary_clusters(const WalkableTets& mesh);

}  // namespace plume
