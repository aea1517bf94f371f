/// The benchmarks' results as a table for people.
#pragma once

#include <string>
#include <vector>

#include "plume/tests/bench/cells_bench.h"
#include "plume/tests/bench/walker_bench.h"

namespace plume::bench {

/// A table for each family that there are results of.
std::string result_table(const std::vector<WalkerResult>& results);

/// What a face costs; empty where nothing was measured.
std::string cells_table(const std::vector<CellsResult>& results);

}  // namespace plume::bench
