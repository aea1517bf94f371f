/// What a walk is for: the modes in which walkers are timed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "plume/preint/closed_form.h"
#include "plume/preint/compositing.h"
#include "plume/preint/piece_table.h"

namespace plume::bench {

/// A walker is asked for more from mode to mode.
enum class Mode : std::uint8_t {
  cells,        ///< which cells are met: the walk alone
  integral,     ///< t and the scalar at every face, as the integral of the scalar along the ray
  isosurface,   ///< the first place of the isovalue; the ray ends there
  volume,       ///< emission and absorption, one sample a cell, no early end
  closed_form,  ///< the same, exact for a transfer function of 8 knots, no early end
};
inline constexpr std::array<Mode, 5> kModes{Mode::cells, Mode::integral, Mode::isosurface,
                                            Mode::volume, Mode::closed_form};
const char* mode_name(Mode mode);

/// What one passage of a ray, from the boundary to the boundary, came to.
struct PassageSum {
  std::uint32_t cells = 0;
  /// integral: length of the passage; isosurface: t of the hit, 0 where there is none; volume and
  /// closed form: what is still seen of what lies behind; in world units.
  float first = 0;
  /// integral: the integral of the scalar; isosurface: nothing; volume and closed form: the sum
  /// of red, green and blue.
  float second = 0;
};

/// Optics by value, the same for all walkers so that walkers are compared and not optics: a table
/// of colour and extinction, read at the nearest entry.
struct OpticsTable {
  struct Entry {
    float r, g, b, extinction;
  };
  std::vector<Entry> entries;
  float low = 0;
  float per_scalar = 0;  ///< entries per unit of scalar

  /// A ramp over [low, high] through blue, white and red, whose extinction grows with the square of
  /// the value to `extinction` per unit of length.
  static OpticsTable ramp(float low, float high, float extinction);

  const Entry& at(float scalar) const {
    const float place = (scalar - low) * per_scalar;
    const float last = static_cast<float>(entries.size() - 1);
    return entries[static_cast<std::size_t>(std::clamp(place, 0.0f, last))];
  }
};

/// The same ramp by 8 knots, linear in between.
TransferFunction ramp_of_knots(float low, float high, float extinction);

/// What the modes have to know.
struct BenchOptics {
  BenchOptics() : closed_form(TransferFunction{{{}}}), pieces(TransferFunction{{{}}}) {}
  BenchOptics(float iso, float low, float high, float extinction)
      : isovalue(iso),
        table(OpticsTable::ramp(low, high, extinction)),
        closed_form(ramp_of_knots(low, high, extinction)),
        pieces(ramp_of_knots(low, high, extinction)) {}

  float isovalue = 0;
  OpticsTable table;
  ClosedForm closed_form;
  PieceTable pieces;
};

/// Consumers take a ray's cells, front to back, until add() returns false. Real: the type in which
/// the walker measures t.
template <class Real>
struct CellsConsumer {
  static constexpr bool kMeasures = false;
  explicit CellsConsumer(const BenchOptics&) {}
  bool add(Real, Real, float, float) { return true; }
  PassageSum sum(std::uint32_t cells) const { return {cells, 0, 0}; }
};

template <class Real>
struct IntegralConsumer {
  static constexpr bool kMeasures = true;
  explicit IntegralConsumer(const BenchOptics&) {}
  bool add(Real t_in, Real t_out, float s_in, float s_out) {
    const Real length = t_out - t_in;
    lengths += length;
    integral += length * (static_cast<Real>(0.5f) * static_cast<Real>(s_in + s_out));
    return true;
  }
  PassageSum sum(std::uint32_t cells) const {
    return {cells, static_cast<float>(lengths), static_cast<float>(integral)};
  }
  Real lengths = 0, integral = 0;
};

template <class Real>
struct IsosurfaceConsumer {
  static constexpr bool kMeasures = true;
  explicit IsosurfaceConsumer(const BenchOptics& optics) : isovalue(optics.isovalue) {}
  bool add(Real t_in, Real t_out, float s_in, float s_out) {
    const float a = s_in - isovalue, b = s_out - isovalue;
    if ((a < 0) == (b < 0)) return true;
    t = static_cast<float>(t_in + (t_out - t_in) * static_cast<Real>(a / (a - b)));
    return false;
  }
  PassageSum sum(std::uint32_t cells) const { return {cells, t, 0}; }
  float isovalue, t = 0;
};

template <class Real>
struct VolumeConsumer {
  static constexpr bool kMeasures = true;
  explicit VolumeConsumer(const BenchOptics& optics) : table(optics.table) {}
  bool add(Real t_in, Real t_out, float s_in, float s_out) {
    const OpticsTable::Entry& sample = table.at(0.5f * (s_in + s_out));
    const float left =
        transmittance * std::exp(-sample.extinction * static_cast<float>(t_out - t_in));
    const float emitted = transmittance - left;
    r += emitted * sample.r;
    g += emitted * sample.g;
    b += emitted * sample.b;
    transmittance = left;
    return true;
  }
  PassageSum sum(std::uint32_t cells) const { return {cells, transmittance, r + g + b}; }
  const OpticsTable& table;
  float r = 0, g = 0, b = 0, transmittance = 1;
};

/// The scalar twin's closed form.
template <class Real>
struct ClosedFormConsumer {
  static constexpr bool kMeasures = true;
  explicit ClosedFormConsumer(const BenchOptics& optics) : closed_form(optics.closed_form) {}
  bool add(Real t_in, Real t_out, float s_in, float s_out) {
    sums.add(closed_form.integrate(s_in, s_out, static_cast<float>(t_out - t_in)));
    return true;
  }
  PassageSum sum(std::uint32_t cells) const {
    return {cells, static_cast<float>(sums.transmittance),
            static_cast<float>(sums.rgb[0] + sums.rgb[1] + sums.rgb[2])};
  }
  const ClosedForm& closed_form;
  Compositor sums;
};

/// Calls f.template operator()<Consumer>() with the mode's consumer.
template <class Real, class F>
void with_consumer(Mode mode, F&& f) {
  switch (mode) {
    case Mode::cells:
      return f.template operator()<CellsConsumer<Real>>();
    case Mode::integral:
      return f.template operator()<IntegralConsumer<Real>>();
    case Mode::isosurface:
      return f.template operator()<IsosurfaceConsumer<Real>>();
    case Mode::volume:
      return f.template operator()<VolumeConsumer<Real>>();
    case Mode::closed_form:
      return f.template operator()<ClosedFormConsumer<Real>>();
  }
}

}  // namespace plume::bench
