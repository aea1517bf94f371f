/// The thesis' rates of walking hexahedra, beside ours.
#pragma once

#include <string>
#include <vector>

#include "plume/tests/bench/walker_bench.h"

namespace plume::bench {

/// Table 6.5, with what was measured of the same meshes in the same modes ("-": not in this run).
std::string thesis_hexahedra(const std::vector<WalkerResult>& results);

}  // namespace plume::bench
