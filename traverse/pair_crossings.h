/// Which way out belongs to which way in, for a cell that the ray crosses more than once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>

#include "plume/traverse/measure.h"

namespace plume {

/// One crossing of a cell's face. A face may be crossed more than once; `rank` tells its crossings
/// apart, by what was decided and not by where they were measured, so it means the same one to both
/// cells at the face.
struct CellCrossing {
  Crossing place;
  std::uint32_t face;
  std::uint32_t rank;
  bool out;
};

/// Pairs ways in with ways out in the order along the ray and returns the one that belongs to the
/// entry (face, rank). The i-th way in goes with the i-th way out, so the pairing is one-to-one
/// whatever the measurements say, and depends on nothing but the cell and the ray. Two crossings
/// that nearly coincide (a face just grazed) may be measured in the wrong order, or at the same z:
/// the walk then meets the cells in another order, or leaves out the sliver between the two (a
/// closed path of its own, which no way in from the boundary leads to), and is as complete.
/// Nothing where the entry is none of the cell's. `crossings` (size many) is sorted in place;
/// `sign` is the ray's.
inline std::optional<CellCrossing> exit_for(CellCrossing* crossings, std::size_t size,
                                            std::uint32_t face, std::uint32_t rank, int sign) {
  auto before = [sign](const CellCrossing& a, const CellCrossing& b) {
    if (a.out != b.out) return b.out;
    // Ties are turned around with the ray too, so that it takes the same way back.
    const CellCrossing& near = sign > 0 ? a : b;
    const CellCrossing& far = sign > 0 ? b : a;
    return std::tie(near.place.z, near.face, near.rank) < std::tie(far.place.z, far.face, far.rank);
  };
  // Hardly ever more than four: by insertion.
  for (std::size_t i = 1; i < size; ++i)
    for (std::size_t j = i; j > 0 && before(crossings[j], crossings[j - 1]); --j)
      std::swap(crossings[j], crossings[j - 1]);
  const std::size_t ways_in = size / 2;
  for (std::size_t i = 0; i < ways_in; ++i)
    if (!crossings[i].out && crossings[i].face == face && crossings[i].rank == rank)
      return crossings[ways_in + i];
  return std::nullopt;
}

}  // namespace plume
