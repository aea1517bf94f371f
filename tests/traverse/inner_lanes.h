/// The scalar inside of cells by vectors, for tests.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "plume/mesh/walkable_cells.h"
#include "plume/mesh/walkable_grid.h"
#include "plume/traverse/segment.h"
#include "plume/traverse/sheared_frame.h"

namespace plume::test {

/// A segment in a cell, from one z of the ray's frame to another.
struct InnerQuery {
  const ShearedFrame* frame;
  float z_in, z_out;
  std::uint32_t cell;
};

struct InnerAnswer {
  bool known = false;
  std::array<float, 2> inner{};
};

/// Asks for as many segments at a time as there are lanes. All rays' longest axis is `axis`; order
/// quadratic or cubic.
std::vector<InnerAnswer> ask_lanes(const WalkableGrid& mesh, int axis,
                                   std::span<const InnerQuery> queries, ScalarOrder order);
std::vector<InnerAnswer> ask_lanes(const WalkableCells& mesh, int axis,
                                   std::span<const InnerQuery> queries, ScalarOrder order);

}  // namespace plume::test
