#include "plume/preint/adaptive_integrator.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "plume/preint/curved_pieces.h"

namespace plume {

namespace {

/// A node in (0, 1), which stands for -node as well, and its weight; the rule is for [-1, 1].
struct Node {
  double position;
  double weight;
};

constexpr std::array<Node, 2> four_nodes{{
    {0.3399810435848562648, 0.6521451548625461426},
    {0.8611363115940525752, 0.3478548451374538574},
}};

constexpr std::array<Node, 4> eight_nodes{{
    {0.1834346424956498049, 0.3626837833783619830},
    {0.5255324099163289858, 0.3137066458778872873},
    {0.7966664774136267396, 0.2223810344533744705},
    {0.9602898564975362317, 0.1012285362903762592},
}};

/// The integral over a piece of what is absorbed at a place times how much the scalar has changed
/// up to there: what the slope of the colours is to be multiplied with.
class Turn {
 public:
  /// `tolerance` is of the integral times `scale`, relative to what is absorbed. What lies deeper
  /// than `visible_depth` is left out.
  Turn(const CurvedPiece& piece, double length, double scale, double tolerance,
       double visible_depth)
      : piece_(piece),
        length_(length),
        scale_(scale),
        tolerance_(tolerance),
        visible_depth_(visible_depth) {}

  double integral() const { return between(0, 1, 0); }

 private:
  template <std::size_t count>
  double by_nodes(const std::array<Node, count>& nodes, double from, double to) const {
    const double middle = (from + to) / 2, half = (to - from) / 2;
    const auto at = [&](double v) {
      return piece_.extinction(v) * piece_.scalar_change(v) * std::exp(-length_ * piece_.depth(v));
    };
    double sum = 0;
    for (const Node& node : nodes)
      sum += node.weight * (at(middle - half * node.position) + at(middle + half * node.position));
    return sum * half * length_;
  }

  double between(double from, double to, int halvings) const {
    const double before = length_ * piece_.depth(from), after = length_ * piece_.depth(to);
    if (before > visible_depth_) return 0;
    // Deeper than this, all nodes could lie where nothing is left to be seen, and agree on that.
    constexpr double greatest_depth = 4;
    // By then the ends are neighbouring doubles.
    constexpr int most_halvings = 53;
    if (after - before <= greatest_depth || halvings == most_halvings) {
      const double fine = by_nodes(eight_nodes, from, to);
      const double absorbed = std::exp(-before) * -std::expm1(before - after);
      const double difference = scale_ * std::abs(fine - by_nodes(four_nodes, from, to));
      // Eight nodes are of twice the order of four, and off by less than the difference's square:
      // for exp(-m u) by 5e-5 of it, whatever m is, by the rules' error terms.
      if (difference * difference <= tolerance_ * absorbed * absorbed || halvings == most_halvings)
        return fine;
    }
    const double middle = (from + to) / 2;
    return between(from, middle, halvings + 1) + between(middle, to, halvings + 1);
  }

  const CurvedPiece& piece_;
  double length_, scale_, tolerance_, visible_depth_;
};

}  // namespace

PreciseColor integrate_curved(std::span<const CurvedPiece> pieces, double length, double tolerance,
                              double largest_color) {
  double visible_depth = -std::log(tolerance) + 1;  // from the piece's front on
  PreciseColor color;
  for (const CurvedPiece& piece : pieces) {
    const double piece_length = piece.share * length;
    const double depth = std::max(0.0, piece_length * piece.depth(1));
    if (depth == 0) continue;
    const double alpha = -std::expm1(-depth);
    PreciseColor part{{}, alpha};
    const auto& slope = piece.slope.color;
    const double steepest = std::max({std::abs(slope[0]), std::abs(slope[1]), std::abs(slope[2])});
    double turn = 0;
    if (steepest > 0 && visible_depth > 0)
      turn =
          Turn(piece, piece_length, steepest / largest_color, tolerance, visible_depth).integral();
    for (std::size_t channel = 0; channel < 3; ++channel)
      part.rgb[channel] = std::max(0.0, piece.base.color[channel] * alpha + slope[channel] * turn);
    color.add_behind(part);
    visible_depth -= depth;
    if (color.alpha >= 1) break;
  }
  return color;
}

AdaptiveIntegrator::AdaptiveIntegrator(const TransferFunction& transfer_function, double tolerance)
    : pieces_(transfer_function), tolerance_(tolerance) {
  assert(tolerance >= 1e-13 && tolerance <= 1);
  for (const auto& knot : transfer_function.knots)
    for (const float channel : knot.optics.color)
      largest_color_ = std::max(largest_color_, static_cast<double>(channel));
}

PreciseColor AdaptiveIntegrator::integrate_precisely(const ScalarPolynomial& scalar,
                                                     double length) const {
  if (!(length > 0)) return {};
  std::vector<CurvedPiece> list;
  cut_at_knots(pieces_, scalar, list);
  return integrate_curved(list, length, tolerance_, largest_color_);
}

float AdaptiveIntegrator::optical_depth(const ScalarPolynomial& scalar, float length) const {
  if (!(length > 0)) return 0;
  std::vector<CurvedPiece> list;
  cut_at_knots(pieces_, scalar, list);
  double depth = 0;
  for (const CurvedPiece& piece : list) depth += piece.share * std::max(0.0, piece.depth(1));
  return saturated_float(depth * length);
}

}  // namespace plume
