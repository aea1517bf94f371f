/// What a ray's segments add up to in each mode: the consumers of segments.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "plume/preint/compositing.h"
#include "plume/preint/optical_depth.h"
#include "plume/preint/scalar_polynomial.h"
#include "plume/preint/segment_optics.h"
#include "plume/traverse/segment.h"

namespace plume {

inline float segment_length(const Segment& segment) {
  return static_cast<float>(segment.t_out - segment.t_in);
}

/// The scalar along a segment of order 2 or 3.
inline ScalarPolynomial polynomial_of(const Segment& segment) {
  return segment.order == ScalarOrder::quadratic
             ? ScalarPolynomial::quadratic(segment.s_in, segment.inner[0], segment.s_out)
             : ScalarPolynomial::cubic(segment.s_in, segment.inner[0], segment.inner[1],
                                       segment.s_out);
}

/// Calls visit(const Segment&) for parts of the segment that are linear within `tolerance` (see
/// ScalarPolynomial), in turn, until it returns false; returns whether all were visited.
template <class Visit>
bool for_each_linear_part(const Segment& segment, double tolerance, Visit&& visit) {
  if (segment.order == ScalarOrder::linear) return visit(segment);
  const double length = segment.t_out - segment.t_in;
  Segment part = segment;
  part.order = ScalarOrder::linear;
  return polynomial_of(segment).for_each_linear_piece(
      tolerance, [&](double, double u_out, float s_in, float s_out) {
        part.t_out = u_out == 1 ? segment.t_out : segment.t_in + u_out * length;
        part.s_in = s_in;
        part.s_out = s_out;
        const bool more = visit(static_cast<const Segment&>(part));
        part.t_in = part.t_out;
        return more;
      });
}

/// Cuts a segment into parts that the integrator takes (see CurvedSegmentIntegrator), and calls
///     visit(length, scalar...)
/// where `scalar` is a ScalarPolynomial or the two ends of a linear part, until it returns false;
/// returns whether all were visited. Of the scalar, parts are right within `tolerance`.
template <class Integrator, class Visit>
bool for_each_part(const Segment& segment, const Integrator&, double tolerance, Visit&& visit) {
  if constexpr (CurvedSegmentIntegrator<Integrator>) {
    if (segment.order != ScalarOrder::linear) {
      const ScalarPolynomial scalar = polynomial_of(segment);
      const float length = segment_length(segment);
      if (scalar.degree() <= Integrator::highest_degree) return visit(length, scalar);
      static_assert(Integrator::highest_degree >= 2);
      return scalar.for_each_quadratic_piece(
          tolerance, [&](const ScalarPolynomial& piece, double share) {
            return visit(static_cast<float>(share) * length, piece);
          });
    }
  }
  return for_each_linear_part(segment, tolerance, [&](const Segment& part) {
    return visit(segment_length(part), part.s_in, part.s_out);
  });
}

/// Emission and absorption.
template <class Integrator>
struct VolumePixel {
  const Integrator& integrator;
  float early_termination;
  double tolerance;  ///< of the parts of segments
  Compositor compositor{};

  bool operator()(const Segment& segment) {
    return for_each_part(segment, integrator, tolerance,
                         [this](float length, const auto&... scalar) {
                           compositor.add(integrator.integrate(scalar..., length));
                           return !compositor.opaque(early_termination);
                         });
  }
};

/// The integral of the scalar over a segment, exact for its polynomial; NaN where it is not known.
inline double scalar_integral(const Segment& segment) {
  const double mean = segment.order == ScalarOrder::linear
                          ? 0.5 * (static_cast<double>(segment.s_in) + segment.s_out)
                          : polynomial_of(segment).mean();
  return mean * (segment.t_out - segment.t_in);
}

// What follows adds up one number a ray: `value()`, and whether the ray `seen()` any. Where a
// segment's scalar is NaN it is passed over.

/// The greatest scalar, that of the extrema inside of cells too; NaN where there is none.
struct MaximumPixel {
  float maximum = -std::numeric_limits<float>::infinity();

  bool operator()(const Segment& segment) {
    maximum = std::fmax(maximum, segment.order == ScalarOrder::linear
                                     ? std::fmax(segment.s_in, segment.s_out)
                                     : polynomial_of(segment).maximum());
    return true;
  }
  /// Whether a value between these may be greater.
  bool matters(float, float greatest) const { return !(greatest <= maximum); }
  bool seen() const { return maximum > -std::numeric_limits<float>::infinity(); }
  double value() const { return seen() ? maximum : std::numeric_limits<float>::quiet_NaN(); }
};

/// The least scalar, likewise.
struct MinimumPixel {
  float minimum = std::numeric_limits<float>::infinity();

  bool operator()(const Segment& segment) {
    minimum = std::fmin(minimum, segment.order == ScalarOrder::linear
                                     ? std::fmin(segment.s_in, segment.s_out)
                                     : polynomial_of(segment).minimum());
    return true;
  }
  /// Whether a value between these may be less.
  bool matters(float least, float) const { return !(least >= minimum); }
  bool seen() const { return minimum < std::numeric_limits<float>::infinity(); }
  double value() const { return seen() ? minimum : std::numeric_limits<float>::quiet_NaN(); }
};

/// The integral of the scalar; 0 where there is none.
struct IntegralPixel {
  double integral = 0;
  bool any = false;

  bool operator()(const Segment& segment) {
    any = true;
    const double part = scalar_integral(segment);
    if (!std::isnan(part)) integral += part;
    return true;
  }
  bool seen() const { return any; }
  double value() const { return integral; }
};

/// The integral of the scalar divided by the length over which it is known; NaN where that is 0.
struct AveragePixel {
  double integral = 0, length = 0;

  bool operator()(const Segment& segment) {
    const double part = scalar_integral(segment);
    if (std::isnan(part)) return true;
    integral += part;
    length += segment.t_out - segment.t_in;
    return true;
  }
  bool seen() const { return length > 0; }
  double value() const {
    return seen() ? integral / length : std::numeric_limits<double>::quiet_NaN();
  }
};

/// The cells that the ray goes through, each as often as it comes in. A cell's part may come as
/// several segments, which join.
struct CellCountPixel {
  std::uint64_t cells = 0;
  std::uint32_t cell = 0xFFFFFFFFu;
  double end = 0;

  bool operator()(const Segment& segment) {
    if (cells == 0 || segment.cell != cell || segment.t_in != end) ++cells;
    cell = segment.cell;
    end = segment.t_out;
    return true;
  }
  bool seen() const { return cells > 0; }
  double value() const { return static_cast<double>(cells); }
};

/// The optical depth.
struct OpticalDepthPixel {
  const OpticalDepth& optics;
  double tolerance;  ///< of the linear parts of segments
  double depth = 0;
  bool any = false;

  bool operator()(const Segment& segment) {
    any = true;
    return for_each_linear_part(segment, tolerance, [this](const Segment& part) {
      depth += optics(part.s_in, part.s_out, segment_length(part));
      return true;
    });
  }
  bool seen() const { return any; }
  double value() const { return depth; }
};

/// The distance to where extinction begins, on the first linear part that is not transparent;
/// infinite where there is none.
struct FirstPixel {
  const OpticalDepth& optics;
  double tolerance;  ///< of the linear parts of segments
  double depth = std::numeric_limits<double>::infinity();
  std::uint32_t cell = 0xFFFFFFFFu;

  bool operator()(const Segment& segment) {
    return for_each_linear_part(segment, tolerance, [this](const Segment& part) {
      if (!(optics(part.s_in, part.s_out, segment_length(part)) > 0)) return true;
      depth = part.t_in + clear_share(part) * (part.t_out - part.t_in);
      cell = part.cell;
      return false;
    });
  }
  bool seen() const { return depth < std::numeric_limits<double>::infinity(); }
  double value() const { return depth; }

 private:
  // How much of a part, which is not all transparent, is so before extinction begins: optical depth
  // never falls along the ray, so that halving finds it, to 2^-24 of the part.
  double clear_share(const Segment& part) const {
    auto is_clear = [&](double share) {
      const auto there = static_cast<float>(part.s_in + share * (part.s_out - part.s_in));
      return !(optics.mean_extinction(part.s_in, there) > 0);
    };
    if (!is_clear(0)) return 0;
    double low = 0, high = 1;
    for (int bit = 0; bit < 24; ++bit) {
      const double middle = (low + high) / 2;
      (is_clear(middle) ? low : high) = middle;
    }
    return low;
  }
};

}  // namespace plume
