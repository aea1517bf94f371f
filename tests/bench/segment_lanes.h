/// Segments by vectors: the closed form as packets evaluate it, and a table look-up to compare
/// with.
#pragma once

#include <cstddef>
#include <vector>

#include "plume/preint/piece_table.h"
#include "plume/preint/preintegrated_table.h"

namespace plume::bench {

/// Segment 16 i + k is the one after 16 (i - 1) + k on the same ray, of 16 rays side by side.
struct LaneSegments {
  static constexpr std::size_t rays = 16;
  std::vector<float> s_in, s_out, length;

  std::size_t size() const { return s_in.size(); }
};

/// Of each segment alone, in front of black.
struct LaneColors {
  std::vector<float> r, g, b, alpha;

  void resize(std::size_t size) {
    for (auto* channel : {&r, &g, &b, &alpha}) channel->resize(size);
  }
};

/// preint/closed_form-inl.h with the widest instruction set that there is. `colors` must have the
/// segments' size, which must be a multiple of 16.
void closed_form_by_lanes(const PieceTable& pieces, const LaneSegments& segments,
                          LaneColors& colors);

/// Trilinear look-up in the same entries as PreintegratedTable::integrate, with one 16-byte load
/// for each of eight entries a lane (LoadFour), as the closed form fetches its pieces. All segments
/// must be within the table, which must have an axis of lengths; to be timed, and no more exact
/// than the table.
void table_by_lanes(const PreintegratedTable& table, const LaneSegments& segments,
                    LaneColors& colors);

}  // namespace plume::bench
