/// The consumer of segments for scenes with interval volumes or isosurfaces.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "plume/lib/pixel.h"
#include "plume/lib/shading.h"
#include "plume/preint/classified_optics.h"
#include "plume/preint/compositing.h"
#include "plume/preint/interval_state.h"
#include "plume/traverse/segment.h"

namespace plume {

/// A place on a ray where it meets an isosurface or comes into an interval.
struct SurfaceHit {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t cell = 0xFFFFFFFFu;  ///< of the walkable mesh
  float scalar = std::numeric_limits<float>::quiet_NaN();

  bool is_one() const { return t < std::numeric_limits<double>::infinity(); }
};

struct ClassifiedPixelSettings {
  double early_termination;  ///< transmittance at which the ray ends
  double tolerance;          ///< of the linear parts of segments
  /// Segments farther apart than this, in world units, are in different passages. What rounding
  /// leaves between blocks that touch is not.
  double gap;
  bool shade_intervals;
  /// End at the first hit.
  bool first_hit_only = false;
  /// Go on to the ray's end whatever was seen, and add up the optical depth.
  bool whole_ray = false;
};

/// Composites volume, intervals and isosurfaces in the order in which a ray meets them.
///
/// `shade(const SurfaceHit&)` gives the Shading of a hit; it is asked once for each isosurface
/// crossed and, where `shade_intervals`, once for each visit to an interval, which then has that
/// shading throughout: the interval is lit as its surface is. Cut faces are not asked for: a cut is
/// no surface of the field.
///
/// Segments of order 2 and 3 are taken in linear parts, as by VolumePixel; but where they cross
/// an isosurface or come into an interval is found on the polynomial itself
/// (ScalarPolynomial::place_of).
template <class Integrator, class Shade>
class ClassifiedPixel {
 public:
  ClassifiedPixel(const ClassifiedOptics& optics, const Integrator& volume, const Shade& shade,
                  const ClassifiedPixelSettings& settings)
      : optics_(optics),
        volume_(volume),
        shade_(shade),
        settings_(settings),
        state_(optics.ranges()) {}

  bool operator()(const Segment& segment) {
    if (segment.t_in - end_ > settings_.gap) state_.reset();
    end_ = segment.t_out;
    cells_(segment);
    const double length = segment.t_out - segment.t_in;
    if (segment.order == ScalarOrder::linear)
      return state_.add(segment.s_in, segment.s_out, [&](const ClassifiedPart& part) {
        return add(part, segment.cell, segment.s_in, length,
                   segment.t_in + part.share_from * length);
      });
    const ScalarPolynomial polynomial = polynomial_of(segment);
    return polynomial.for_each_linear_piece(settings_.tolerance, [&](double u_in, double u_out,
                                                                     float s_in, float s_out) {
      return state_.add(s_in, s_out, [&](const ClassifiedPart& part) {
        const double u = begins_at_value(part) ? polynomial.place_of(scalar_of(part), u_in, u_out)
                                               : u_in + part.share_from * (u_out - u_in);
        return add(part, segment.cell, s_in, (u_out - u_in) * length, segment.t_in + u * length);
      });
    });
  }

  /// Segments are left out before the next one that are empty, outside of all intervals, and on
  /// which no isosurface is crossed.
  void pass_over() { end_ = -std::numeric_limits<double>::infinity(); }

  Compositor compositor;
  /// The first isosurface or interval that is not transparent.
  SurfaceHit first;
  double optical_depth = 0;  ///< where the whole ray is seen
  std::uint64_t cells() const { return cells_.cells; }
  std::uint64_t surfaces = 0;  ///< isosurfaces crossed
  std::uint64_t visits = 0;    ///< to intervals

 private:
  // The piece of which the part is one begins at s_in and has that length; the part begins at t.
  bool add(const ClassifiedPart& part, std::uint32_t cell, float s_in, double length, double t) {
    if (settings_.whole_ray) optical_depth += optics_.optical_depth(part, length, volume_);
    SegmentColor color = optics_.color(part, length, volume_);
    if (part.kind != ClassifiedPart::Kind::volume) {
      const SurfaceHit hit{t, cell, part.clipped ? s_in : scalar_of(part)};
      if (color.alpha > 0 && !first.is_one()) first = hit;
      color = shaded(part, hit, color);
      if (settings_.first_hit_only && first.is_one()) return false;
    }
    compositor.add(color);
    return settings_.whole_ray || !compositor.opaque(settings_.early_termination);
  }

  // Whether a part begins where the ray crosses an isosurface or the end of an interval.
  static bool begins_at_value(const ClassifiedPart& part) {
    return part.kind == ClassifiedPart::Kind::surface || (part.first_of_visit && !part.clipped);
  }

  float scalar_of(const ClassifiedPart& part) const {
    return part.kind == ClassifiedPart::Kind::interval
               ? optics_.ranges().scalar_of(part.index, part.from)
               : part.from;
  }

  SegmentColor shaded(const ClassifiedPart& part, const SurfaceHit& hit,
                      const SegmentColor& color) {
    if (part.kind == ClassifiedPart::Kind::surface) {
      ++surfaces;
      return shade_(hit).applied(color);
    }
    if (part.first_of_visit) {
      ++visits;
      visit_ = settings_.shade_intervals && !part.clipped ? shade_(hit) : Shading{};
    }
    return visit_.applied(color);
  }

  const ClassifiedOptics& optics_;
  const Integrator& volume_;
  const Shade& shade_;
  const ClassifiedPixelSettings settings_;
  IntervalState state_;
  CellCountPixel cells_;
  double end_ = -std::numeric_limits<double>::infinity();
  Shading visit_;  // of the interval that the ray is in
};

}  // namespace plume
