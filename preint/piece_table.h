/// A transfer function cut at its knots, in single precision, for the vectorised closed form.
#pragma once

#include <cstddef>
#include <vector>

#include "plume/preint/transfer_function.h"

namespace plume {

/// Piece i covers the scalars from low to high; before the first knot and behind the last lie
/// pieces without end on which nothing changes. Numbers count from the piece's anchor: its end of
/// less extinction, which is `high` where extinction_slope has a sign (a negative zero is for the
/// piece that has no low end), else `low`. With r = scalar - anchor, extinction is extinction + r *
/// extinction_slope, a sum in which nothing cancels, and each colour likewise. A step is a piece of
/// no width.
struct PieceTable {
  /// Three times four floats, so that a lane's is fetched with three loads.
  struct Piece {
    float low, high, extinction, extinction_slope;
    float color[3], unused;
    float color_slope[3], unused_too;
  };

  /// Requires !transfer_function.problem().
  explicit PieceTable(const TransferFunction& transfer_function);

  /// The piece that a scalar enters when it rises from `scalar`. Any piece will do for NaN.
  std::size_t piece_at(float scalar) const;

  std::vector<Piece> pieces;
};

}  // namespace plume
