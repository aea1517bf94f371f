/// A transfer function cut at its knots: between two of them, optics are linear in the scalar.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <vector>

#include "plume/preint/transfer_function.h"

namespace plume {

/// Optics in double precision, so that sums over many pieces are good to the last bit of a float.
struct PreciseOptics {
  double extinction = 0;                 ///< as Optics::extinction
  std::array<double, 3> color{0, 0, 0};  ///< as Optics::color
};

/// The knots with one more far below and one far above them, which makes the constant ends of a
/// transfer function into pieces like all others. Piece i lies between knots i and i + 1; the piece
/// inside a step has no width.
///
/// Extinction is good to a few units in the last place of a double, also where it falls to zero:
/// both weights of the interpolation come from a difference of scalars. Colours are good to as much
/// of the larger of the two knots' values; a colour that does not vary is exact.
class Pieces {
 public:
  /// Requires !transfer_function.problem().
  explicit Pieces(const TransferFunction& transfer_function);

  std::size_t knot_count() const { return scalars_.size(); }        ///< the two far ones included
  double scalar(std::size_t knot) const { return scalars_[knot]; }  ///< of a knot
  /// At a knot.
  const PreciseOptics& optics(std::size_t knot) const { return optics_[knot]; }

  /// The piece that a scalar enters when it rises from `scalar`; also where `scalar` itself lies,
  /// for at a step the later knot holds. Requires a finite float.
  std::size_t piece_above(double scalar) const;

  /// The piece that a scalar enters when it falls from `scalar`. Requires a finite float.
  std::size_t piece_below(double scalar) const;

  /// Optics at a scalar inside a piece or at its ends.
  PreciseOptics at(std::size_t piece, double scalar) const;

  /// What the optics of a piece change by per unit of the scalar; 0 inside a step.
  PreciseOptics slope(std::size_t piece) const;

  /// Optics at a finite scalar.
  PreciseOptics at(double scalar) const { return at(piece_above(scalar), scalar); }

  /// Walks from `s_in` to `s_out` (both finite) and calls, for each piece on the way,
  ///     visit(const PreciseOptics& front, const PreciseOptics& back, double fraction)
  /// where optics run linearly from `front` to `back` and `fraction` is the piece's share of the
  /// way; the shares add up to 1, and a step's is 0. `visit` returns false to end the walk. A
  /// constant scalar is one visit. A way that begins or ends at a step sees only its own side.
  template <class Visit>
  void walk(double s_in, double s_out, Visit&& visit) const {
    if (s_in == s_out) {
      const PreciseOptics here = at(s_in);
      visit(here, here, 1.0);
      return;
    }
    if (s_out > s_in) {
      walk_towards<+1>(piece_above(s_in), s_in, s_out, visit);
    } else {
      walk_towards<-1>(piece_below(s_in), s_in, s_out, visit);
    }
  }

 private:
  template <int direction, class Visit>
  void walk_towards(std::size_t first_piece, double s_in, double s_out, Visit& visit) const {
    const double inverse_way = 1 / (s_out - s_in);
    double scalar = s_in;
    PreciseOptics front = at(first_piece, s_in);
    // The knot at the far end of the current piece.
    std::size_t ahead = direction > 0 ? first_piece + 1 : first_piece;
    while (direction > 0 ? scalars_[ahead] < s_out : scalars_[ahead] > s_out) {
      if (!visit(front, optics_[ahead], (scalars_[ahead] - scalar) * inverse_way)) return;
      scalar = scalars_[ahead];
      front = optics_[ahead];
      ahead = next<direction>(ahead);
    }
    visit(front, at(direction > 0 ? ahead - 1 : ahead, s_out), (s_out - scalar) * inverse_way);
  }

  template <int direction>
  static std::size_t next(std::size_t index) {
    return direction > 0 ? index + 1 : index - 1;
  }

  std::vector<double> scalars_;
  std::vector<PreciseOptics> optics_;
  /// 1 / width of each piece; 0 for the piece inside a step.
  std::vector<double> inverse_widths_;
};

}  // namespace plume
