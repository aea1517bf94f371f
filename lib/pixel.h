/// What a ray's segments add up to in each mode: the consumers of segments.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "plume/preint/compositing.h"
#include "plume/preint/scalar_polynomial.h"
#include "plume/preint/segment_optics.h"
#include "plume/preint/transfer_function.h"
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
  double tolerance;  ///< of the linear parts of segments
  Compositor compositor{};

  bool operator()(const Segment& segment) {
    return for_each_part(segment, integrator, tolerance,
                         [this](float length, const auto&... scalar) {
                           compositor.add(integrator.integrate(scalar..., length));
                           return !compositor.opaque(early_termination);
                         });
  }
};

/// The greatest scalar, that of the extrema inside of cells too. NaN is passed over; -infinity
/// where there is none.
struct MaximumPixel {
  float maximum = -std::numeric_limits<float>::infinity();

  bool operator()(const Segment& segment) {
    maximum = std::fmax(maximum, segment.order == ScalarOrder::linear
                                     ? std::fmax(segment.s_in, segment.s_out)
                                     : polynomial_of(segment).maximum());
    return true;
  }
};

/// The integral of the scalar, exact for a segment's polynomial. NaN counts as nothing.
struct IntegralPixel {
  double integral = 0;

  bool operator()(const Segment& segment) {
    const double mean = segment.order == ScalarOrder::linear
                            ? 0.5 * (static_cast<double>(segment.s_in) + segment.s_out)
                            : polynomial_of(segment).mean();
    if (!std::isnan(mean)) integral += mean * (segment.t_out - segment.t_in);
    return true;
  }
};

/// The first segment, or linear part of one, that is not transparent.
template <class Integrator>
struct FirstPixel {
  const Integrator& integrator;
  double tolerance;  ///< of the linear parts of segments
  double depth = std::numeric_limits<double>::infinity();
  std::uint32_t cell = 0xFFFFFFFFu;

  bool operator()(const Segment& segment) {
    return for_each_linear_part(segment, tolerance, [this](const Segment& part) {
      if (!(integrator.optical_depth(part.s_in, part.s_out, segment_length(part)) > 0)) return true;
      depth = part.t_in;
      cell = part.cell;
      return false;
    });
  }
};

/// What the further channels hold, gathered besides the picture.
template <class Integrator>
struct ChannelPixel {
  FirstPixel<Integrator> first;
  double optical_depth = 0;
  std::uint64_t cells = 0;

  void operator()(const Segment& segment) {
    if (!(first.depth < std::numeric_limits<double>::infinity())) first(segment);
    for_each_part(segment, first.integrator, first.tolerance,
                  [this](float length, const auto&... scalar) {
                    optical_depth += first.integrator.optical_depth(scalar..., length);
                    return true;
                  });
    ++cells;
  }
};

}  // namespace plume
