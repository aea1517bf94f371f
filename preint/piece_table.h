/// A transfer function cut at its knots, in single precision, for the vectorised closed form.
#pragma once

#include <cstddef>
#include <vector>

#include "plume/preint/transfer_function.h"

namespace plume {

/// Piece i covers scalars from low[i] to low[i + 1]; before the first knot and behind the last lie
/// pieces without end on which nothing changes. On piece i, with r = scalar - base[i], extinction is
/// extinction[i] + r * extinction_slope[i], and each colour likewise. A step is a piece of no width.
/// All arrays are padded to a multiple of 16 entries.
struct PieceTable {
  /// Requires !transfer_function.problem().
  explicit PieceTable(const TransferFunction& transfer_function);

  /// The piece that a scalar enters when it rises from `scalar`. Any piece will do for NaN.
  std::size_t piece_at(float scalar) const;

  std::size_t pieces = 0;
  /// pieces + 1 entries: from -infinity to +infinity.
  std::vector<float> low;
  std::vector<float> base, extinction, extinction_slope;
  std::vector<float> color[3], color_slope[3];
};

}  // namespace plume
