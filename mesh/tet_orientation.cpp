#include "plume/mesh/tet_orientation.h"

#include <algorithm>
#include <utility>

#include "plume/mesh/orientation.h"

namespace plume {
namespace {

void turn(TetAdjacency& tets, const std::vector<std::uint32_t>& cells) {
  if (cells.empty()) return;
  Finding reversed{"tetrahedra listed with the opposite orientation, turned around", 0, {}};
  for (const std::uint32_t c : cells) {
    tets.odd[c] ^= 1;
    add_example(reversed, tets.original[c]);
  }
  tets.findings.push_back(std::move(reversed));
}

// Looks at all cells, one after the other.
void orient_each(TetAdjacency& tets) {
  Finding one_sided{"faces where neighbours cannot agree on a side, taken as boundary", 0, {}};
  std::vector<std::uint32_t> cuts;
  const auto turned = cells_to_turn(
      tets.cells.size(),
      [&](std::uint32_t cell, const auto& visit) {
        for (std::uint32_t face = 4 * cell; face < 4 * cell + 4; ++face)
          if (const std::uint32_t partner = tets.partner(face); partner != kNone)
            visit(partner / 4, tets.agree(face, partner), static_cast<int>(face % 4));
      },
      [&](std::uint32_t cell) { return signed_volume(tets, cell); },
      [&](std::uint32_t cell, int face) {
        cuts.push_back(4 * cell + static_cast<std::uint32_t>(face));
      });
  for (const std::uint32_t face : cuts) {
    tets.partner(face) = kNone;
    add_example(one_sided, tets.original[face / 4]);
  }
  if (one_sided.count > 0) tets.findings.push_back(std::move(one_sided));
  std::vector<std::uint32_t> cells;
  for (std::uint32_t c = 0; c < tets.cells.size(); ++c)
    if (turned[c]) cells.push_back(c);
  turn(tets, cells);
}

// Whether all parts of a mesh whose neighbours agree surely have a positive volume. Those without a
// negative cell have. In any other, one goes from cell to cell until there is more volume than all
// negative cells together could take away. False means: not known.
bool surely_positive(const TetAdjacency& tets, const std::vector<std::uint32_t>& not_positive) {
  double negative = 0;
  for (const std::uint32_t c : not_positive) negative -= signed_volume(tets, c);
  // Far more than rounding could make of the sums.
  const double enough = negative * (1 + 1e-6);
  enum : std::uint8_t { unseen, seen, positive };
  std::vector<std::uint8_t> states(tets.cells.size(), unseen);
  std::vector<std::uint32_t> part;
  for (const std::uint32_t seed : not_positive) {
    if (states[seed] != unseen) continue;
    part.assign(1, seed);
    states[seed] = seen;
    double volume = 0;
    bool known = false;
    for (std::size_t i = 0; i < part.size() && !known; ++i) {
      volume += std::max(signed_volume(tets, part[i]), 0.0);
      known = volume > enough;
      for (const WalkableTets::Link& side : tets.cells[part[i]]) {
        if (side.cell == kNone) continue;
        const std::uint32_t neighbor = side.cell / 4;
        known = known || states[neighbor] == positive;
        if (states[neighbor] != unseen) continue;
        states[neighbor] = seen;
        part.push_back(neighbor);
      }
    }
    if (!known) return false;
    for (const std::uint32_t c : part) states[c] = positive;
  }
  return true;
}

bool all_negative(const TetAdjacency& tets, const std::vector<std::uint32_t>& not_positive) {
  return not_positive.size() == tets.cells.size() &&
         std::all_of(not_positive.begin(), not_positive.end(),
                     [&](std::uint32_t c) { return signed_volume(tets, c) < 0; });
}

}  // namespace

void orient_tets(TetAdjacency& tets, bool agreed, const std::vector<std::uint32_t>& not_positive) {
  if (!agreed) return orient_each(tets);
  if (not_positive.empty()) return;
  if (all_negative(tets, not_positive)) {
    turn(tets, not_positive);
  } else if (!surely_positive(tets, not_positive)) {
    orient_each(tets);
  }
}

}  // namespace plume
