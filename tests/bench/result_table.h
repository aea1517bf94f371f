/// The benchmarks' results as a table for people, beside the thesis' own.
#pragma once

#include <string>
#include <vector>

#include "plume/tests/bench/tet_bench.h"

namespace plume::bench {

std::string result_table(const std::vector<TetResult>& results);

}  // namespace plume::bench
