/// Several blocks of a file as one mesh.
#pragma once

#include <filesystem>
#include <vector>

#include "plume/io/read_mesh.h"

namespace plume {

/// One mesh of explicit cells with the cells of all blocks, in order; hidden cells of grids are
/// left out. Fields that all blocks have are kept, others are dropped with a notice. Coordinates
/// are double if a block's are.
///
/// With `merge_points`, a point takes the place of the first point with the same coordinates in an
/// earlier block (bit for bit; 0 and -0 are the same). Its field values are those of that first
/// point, and a notice counts the points where they differ. Points within one block stay as they
/// are.
Mesh append_blocks(std::vector<Mesh> blocks, bool merge_points, const std::filesystem::path& file,
                   const Notice& notice);

}  // namespace plume
