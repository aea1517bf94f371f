#include "plume/preint/piece_table.h"

#include <algorithm>
#include <limits>

namespace plume {

PieceTable::PieceTable(const TransferFunction& transfer_function) {
  const auto& knots = transfer_function.knots;
  // Slopes in double: knots may lie far apart or close together.
  auto slope = [](float a, float b, double width) {
    constexpr double kMost = std::numeric_limits<float>::max();
    return width > 0
               ? static_cast<float>(std::clamp((b - static_cast<double>(a)) / width, -kMost, kMost))
               : 0.0f;
  };
  auto add = [&](float low, float high, const Optics& below, const Optics& above) {
    const double width = static_cast<double>(high) - low;
    const bool falls = above.extinction < below.extinction;
    const Optics& anchor = falls ? above : below;
    Piece piece{
        low, high, anchor.extinction, slope(below.extinction, above.extinction, width), {}, 0,
        {},  0};
    if (falls && piece.extinction_slope == 0) piece.extinction_slope = -0.0f;  // of no width
    for (std::size_t c = 0; c < 3; ++c) {
      piece.color[c] = anchor.color[c];
      piece.color_slope[c] = slope(below.color[c], above.color[c], width);
    }
    pieces.push_back(piece);
  };
  add(-std::numeric_limits<float>::infinity(), knots.front().scalar, knots.front().optics,
      knots.front().optics);
  pieces.front().extinction_slope = -0.0f;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i)
    add(knots[i].scalar, knots[i + 1].scalar, knots[i].optics, knots[i + 1].optics);
  add(knots.back().scalar, std::numeric_limits<float>::infinity(), knots.back().optics,
      knots.back().optics);
}

std::size_t PieceTable::piece_at(float scalar) const {
  const auto above = std::upper_bound(pieces.begin(), pieces.end() - 1, scalar,
                                      [](float s, const Piece& piece) { return s < piece.high; });
  return static_cast<std::size_t>(above - pieces.begin());
}

}  // namespace plume
