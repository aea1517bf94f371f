/// The integral of segments along which the scalar is quadratic, from a table.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "plume/preint/adaptive_integrator.h"
#include "plume/preint/closed_form.h"
#include "plume/preint/segment_optics.h"
#include "plume/preint/table_axis.h"
#include "plume/preint/table_entry.h"
#include "plume/preint/transfer_function.h"

namespace plume {

/// What SecondOrderTable is made of.
struct SecondOrderTableSettings {
  /// Entries along each of the three axes of scalars; >= 2.
  int scalar_count = 40;
  /// Entries along the axis of lengths, which is logarithmic; >= 2.
  int length_count = 24;
  /// As in TableSettings.
  std::optional<std::array<float, 2>> scalar_range{};
  std::optional<std::array<float, 2>>
      length_range{};  ///< lengths covered, world units; by default as for TableSettings
  /// The 3D form, of segments that are all that long, in world units; as in TableSettings.
  std::optional<float> constant_length{};

  /// The same in every number.
  bool operator==(const SecondOrderTableSettings&) const = default;

  /// What is wrong, in one line with the value; nothing where all is well.
  std::optional<std::string> problem() const;
};

/// A pre-integrated table of second order, over the scalar at a segment's front, in its middle and
/// at its back, and over the length, which is left out where it is constant. The scalar is the
/// quadratic through the three. Source: El Hajjar, Marchesin, Dischler and Mongenet, "Second Order
/// Pre-Integrated Volume Rendering", PacificVis 2008, equation 2. What an entry holds is in
/// TableEntry.
///
/// Entries are not sums of samples, as there, but integrals: the parabola is cut at its extremum
/// and where it crosses knots, once for all lengths, and each part integrated to 1e-5 of the
/// largest colour (AdaptiveIntegrator).
///
/// Error: that of interpolation, of second order in the spacing where no knot is near, and no
/// bound, as for PreintegratedTable; report() measures it. Memory: 16 bytes an entry, 25 MB at the
/// default size, 4 MB for a constant length and 64 scalars, 34 MB for 128.
///
/// Linear segments go to the closed form, which is exact and faster; so does what the table does
/// not reach (see PreintegratedTable), to AdaptiveIntegrator. Cubics: see highest_degree.
class SecondOrderTable {
 public:
  static constexpr int highest_degree = 2;  ///< of the polynomials that integrate() takes

  /// Requires !transfer_function.problem() and !settings.problem(). Runs on all threads that TBB
  /// has.
  explicit SecondOrderTable(const TransferFunction& transfer_function,
                            const SecondOrderTableSettings& settings = {});

  /// Exact, as ClosedForm's.
  SegmentColor integrate(float s_in, float s_out, float length) const {
    return closed_form_.integrate(s_in, s_out, length);
  }
  /// As SegmentIntegrator has it; not from the table.
  float optical_depth(float s_in, float s_out, float length) const {
    return closed_form_.optical_depth(s_in, s_out, length);
  }

  /// Requires a degree of at most 2.
  SegmentColor integrate(const ScalarPolynomial& scalar, float length) const;

  /// Not from the table: exact, as AdaptiveIntegrator's.
  float optical_depth(const ScalarPolynomial& scalar, float length) const {
    return exact_.optical_depth(scalar, length);
  }

  /// Memory, time to build, measured error.
  const TableReport& report() const { return report_; }

  /// Shortest and longest length that the table covers; {0, 0} where there is no table.
  std::array<float, 2> length_range() const { return {shortest_, longest_}; }

 private:
  void fill(double largest_color);
  void measure();

  ClosedForm closed_form_;
  AdaptiveIntegrator exact_;
  TableAxis scalars_;
  TableAxis lengths_;
  float shortest_ = 0;
  float longest_ = 0;
  /// The longest that is read from the table.
  float reach_ = 0;
  /// entries_[((length * n + back) * n + middle) * n + front]; empty where there is no table.
  std::vector<TableEntry> entries_;
  TableReport report_;
};

static_assert(CurvedSegmentIntegrator<SecondOrderTable>);

}  // namespace plume
