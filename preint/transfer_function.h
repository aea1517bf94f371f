/// A transfer function: what a scalar value looks like.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace plume {

/// Optical properties at one scalar value.
struct Optics {
  /// Extinction per unit of length, >= 0 and finite.
  float extinction = 0;
  /// Linear RGB (Rec. 709 primaries), >= 0. What an opaque slab of this value would show: the
  /// source term of the volume rendering integral is color * extinction.
  std::array<float, 3> color{0, 0, 0};

  /// The same in every number.
  bool operator==(const Optics&) const = default;
};

/// Extinction and colour over the scalar axis, both piecewise linear between knots and constant
/// beyond the first and the last. Two knots at the same scalar make a step; at the step itself the
/// later one holds.
struct TransferFunction {
  /// Optics at a scalar.
  struct Knot {
    float scalar = 0;  ///< in the field's unit
    Optics optics;     ///< there

    /// The same in every number.
    bool operator==(const Knot&) const = default;
  };
  std::vector<Knot> knots;  ///< ascending; see problem()

  /// The same in every number.
  bool operator==(const TransferFunction&) const = default;

  /// What is wrong with the knots, in one line that names the knot; nothing where all is well: at
  /// least one knot, scalars finite and in ascending order (not more than two equal), extinction
  /// finite and >= 0, colours finite and >= 0.
  std::optional<std::string> problem() const;

  /// Optics at a scalar value; NaN is transparent. Requires !problem().
  Optics at(float scalar) const;
};

}  // namespace plume
