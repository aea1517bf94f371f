/// Points of one set that have equal coordinates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace plume {

/// For each point (x, y, z interleaved, finite), the number of the first point with the same
/// coordinates, its own where it is the first; 0 and -0 are the same. Empty where all differ.
std::vector<std::uint32_t> first_coincident(std::span<const double> points);

}  // namespace plume
