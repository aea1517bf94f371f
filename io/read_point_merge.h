/// Merging the points that neighbouring blocks share.
#pragma once

#include <cstdint>
#include <vector>

namespace plume {

/// `points` holds the coordinates of all blocks' points, `ids[block][point]` their numbers in it,
/// counting up. Afterwards a point with the coordinates of one in an earlier block has that one's
/// number, and `points` only those that stay, in order. Numbers still appear in counting order: no
/// point's number exceeds those before it by more than one.
void merge_block_points(std::vector<float>& points, std::vector<std::vector<std::int64_t>>& ids);
void merge_block_points(std::vector<double>& points, std::vector<std::vector<std::int64_t>>& ids);

}  // namespace plume
