/// Every walker of ours on a mesh of a scene, ray by ray and in packets.
#pragma once

#include <vector>

#include "atlas_walk.h"
#include "scenes.h"

namespace plume::atlas {

/// One entry for each walker that is for such a mesh. Packets use the widest instructions of the
/// processor. Rays that packets leave to their twin (they start inside, or passages overlap) are
/// walked by that twin, as in render().
std::vector<MethodWalks> our_walks(const SceneMesh& mesh);

}  // namespace plume::atlas
