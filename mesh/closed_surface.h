/// Whether triangles enclose something.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace plume {

/// Throws Error where an edge has an odd number of triangles, naming the first such edges with
/// their triangles and coordinates. `numbers` are the triangles' numbers in messages. Points are x,
/// y, z, interleaved.
void check_closed(std::span<const double> points,
                  const std::vector<std::array<std::uint32_t, 3>>& triangles,
                  const std::vector<std::uint32_t>& numbers);

/// Which tetrahedra are separated from infinity by an odd number of facets. `neighbors[4 t + i]` is
/// the tetrahedron beyond the face opposite to corner i of t, or -1 at the outside, where every
/// face is a facet. Each edge has an even number of facets (check_closed()), so that the number's
/// parity does not depend on the way to infinity.
std::vector<bool> enclosed(std::span<const std::int32_t> tetrahedra,
                           std::span<const std::int32_t> neighbors,
                           std::span<const std::int32_t> facets);

}  // namespace plume
