#include "plume/preint/curved_pieces.h"

namespace plume {

namespace {

CurvedPiece curved_piece(const Pieces& pieces, std::size_t piece, const ScalarPolynomial& scalar,
                         double from, double to) {
  // Taylor's expansion about the front, in v = (u - from) / (to - from).
  const auto& c = scalar.coefficients();
  const double width = to - from;
  const double first = c[1] + from * (2 * c[2] + from * 3 * c[3]);
  const double second = c[2] + from * 3 * c[3];
  CurvedPiece result{width,
                     {first * width, second * width * width, c[3] * width * width * width},
                     pieces.at(piece, scalar(from)),
                     pieces.slope(piece)};
  return result;
}

}  // namespace

void cut_at_knots(const Pieces& pieces, const ScalarPolynomial& scalar,
                  std::vector<CurvedPiece>& list) {
  list.clear();
  if (!scalar.is_finite()) return;
  double from = 0;
  const auto add = [&](std::size_t piece, double to) {
    if (to > from) list.push_back(curved_piece(pieces, piece, scalar, from, to));
    from = to;
  };
  const auto monotone_part = [&](double to) {
    const double front = scalar(from), back = scalar(to);
    if (back >= front) {
      std::size_t piece = pieces.piece_above(front);
      for (; pieces.scalar(piece + 1) < back; ++piece)
        add(piece, scalar.place_of(pieces.scalar(piece + 1), from, to));
      add(piece, to);
    } else {
      std::size_t piece = pieces.piece_below(front);
      for (; pieces.scalar(piece) > back; --piece)
        add(piece, scalar.place_of(pieces.scalar(piece), from, to));
      add(piece, to);
    }
  };
  for (const double extremum : scalar.extrema()) monotone_part(extremum);
  monotone_part(1);
}

}  // namespace plume
