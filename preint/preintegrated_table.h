/// The segment integral from a table over both scalars and the length.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "plume/preint/closed_form.h"
#include "plume/preint/segment_optics.h"
#include "plume/preint/transfer_function.h"

namespace plume {

/// Size and reach of a PreintegratedTable.
struct TableSettings {
  /// Entries along each of the two axes of scalars; >= 2.
  int scalar_count = 128;
  /// Entries along the axis of lengths, which is logarithmic; >= 2.
  int length_count = 32;
  /// Scalars that the table covers, lowest < highest. By default from the first knot to the last.
  /// Give the field's range where it is narrower.
  std::optional<std::array<float, 2>> scalar_range;
  /// Lengths that the table covers, in world units, 0 < shortest < longest. By default from an
  /// optical depth of 0.01 at the greatest extinction of all knots to one of 100 at the mean
  /// extinction of the range. Give the mesh's lengths where they are known.
  std::optional<std::array<float, 2>> length_range;
};

/// A pre-integrated table, built from the closed form and read with trilinear interpolation.
/// Source: Roettger, Kraus and Ertl, "Hardware-Accelerated Volume and Isosurface Rendering Based on
/// Cell-Projection", Visualization 2000; Engel, Kraus and Ertl, "High-Quality Pre-Integrated Volume
/// Rendering", Graphics Hardware 2001.
///
/// An entry holds the mean extinction m, which no length changes, and q = m * C / alpha, the colour
/// weighted by it. Both stay finite and smooth from the shortest to the longest segment, and
/// entries without extinction lend no colour to their neighbours. A look-up gives
///     alpha = 1 - exp(-m length),   C = q * alpha / m.
///
/// Error: of second order in the spacing of the table where the transfer function has no knot, and
/// of first order next to a step; there is no bound, for what lies between two entries, like a
/// narrow spike, is smeared over both. Measured at the default size: 3e-3 at most and 3e-4 RMS on
/// eight knots without steps; up to 1 on long segments beside a step that ends an empty range.
///
/// A segment shorter than the table's shortest takes the entry of the shortest, which is right to a
/// relative error of about its optical depth. Where the table does not reach, the closed form
/// answers: a scalar outside the range, a segment longer than the longest, and everything if the
/// range is empty or without extinction.
class PreintegratedTable {
 public:
  /// Requires !transfer_function.problem() and valid settings. Runs on all threads that TBB has.
  explicit PreintegratedTable(const TransferFunction& transfer_function,
                              const TableSettings& settings = {});

  /// See SegmentIntegrator.
  SegmentColor integrate(float s_in, float s_out, float length) const;

  /// Not from the table: exact, as ClosedForm's. It differs from -log(1 - alpha) by the table's
  /// error.
  float optical_depth(float s_in, float s_out, float length) const {
    return closed_form_.optical_depth(s_in, s_out, length);
  }

  /// Memory of the table.
  std::size_t bytes() const { return entries_.size() * sizeof(Entry); }

  /// Shortest and longest length that the table covers; {0, 0} where there is no table.
  std::array<float, 2> length_range() const { return {shortest_, longest_}; }

 private:
  /// q for red, green, blue; then m.
  struct alignas(16) Entry {
    std::array<float, 4> values{0, 0, 0, 0};
  };

  void choose_ranges(const TransferFunction& transfer_function, const TableSettings& settings);
  void fill();
  static Entry blend(const Entry& first, const Entry& second, float weight_of_second);

  ClosedForm closed_form_;
  OpticalDepth depth_;
  std::size_t scalar_count_;
  std::size_t length_count_;
  float lowest_ = 0;
  float highest_ = 0;
  float shortest_ = 0;
  float longest_ = 0;
  float shortest_log2_ = 0;
  /// Entries per unit of scalar, and per doubling of length.
  double scalar_density_ = 0;
  float length_density_ = 0;
  /// entries_[(length * scalar_count_ + back) * scalar_count_ + front]; empty where there is no
  /// table.
  std::vector<Entry> entries_;
};

static_assert(SegmentIntegrator<PreintegratedTable>);

}  // namespace plume
