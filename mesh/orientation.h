/// One sense of inside and outside for all cells that hang together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "plume/mesh/face_matching.h"

namespace plume {

/// Decides for each cell whether its faces must be turned around so that any two neighbours see
/// their common face from opposite sides and each connected part has a positive volume in all.
///
/// A cell that is merely inside out (its points moved too far) is not turned: its neighbours agree
/// with it on who is on which side. `for_each_neighbor(cell, f)` calls f(neighbour, agree, face);
/// `signed_volume(cell)` is positive for a cell of positive orientation. `cut(cell, face)` is
/// called where no choice can make two neighbours agree (a one-sided strip of cells); the caller
/// must take the link away on both sides. Returns 1 for the cells to be turned.
template <class ForEachNeighbor, class SignedVolume, class Cut>
std::vector<std::uint8_t> cells_to_turn(std::size_t cells, const ForEachNeighbor& for_each_neighbor,
                                        const SignedVolume& signed_volume, const Cut& cut) {
  constexpr std::uint8_t kUnseen = 2;
  std::vector<std::uint8_t> turned(cells, kUnseen);
  std::vector<std::uint32_t> part;
  for (std::size_t seed = 0; seed < cells; ++seed) {
    if (turned[seed] != kUnseen) continue;
    part.assign(1, static_cast<std::uint32_t>(seed));
    turned[seed] = 0;
    double volume = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const std::uint32_t cell = part[i];
      volume += turned[cell] ? -signed_volume(cell) : signed_volume(cell);
      for_each_neighbor(cell, [&](std::uint32_t neighbor, bool agree, int face) {
        const std::uint8_t wanted = agree ? turned[cell] : static_cast<std::uint8_t>(!turned[cell]);
        if (turned[neighbor] == kUnseen) {
          turned[neighbor] = wanted;
          part.push_back(neighbor);
        } else if (turned[neighbor] != wanted) {
          cut(cell, face);
        }
      });
    }
    if (volume < 0)
      for (const std::uint32_t cell : part) turned[cell] = !turned[cell];
  }
  return turned;
}

}  // namespace plume
