/// The segment integral from a table over both scalars and the length.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "plume/preint/closed_form.h"
#include "plume/preint/segment_optics.h"
#include "plume/preint/table_axis.h"
#include "plume/preint/table_entry.h"
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
  std::optional<std::array<float, 2>> scalar_range{};
  /// Lengths that the table covers, in world units, 0 < shortest < longest. By default from an
  /// optical depth of 0.01 at the greatest extinction of all knots to one of 100 at the mean
  /// extinction of the range. Give the mesh's lengths where they are known.
  std::optional<std::array<float, 2>> length_range{};
  /// The 2D form, of segments that are all that long, in world units: length_count and length_range
  /// are not read. A segment of another length is given the mean extinction and the colour of this
  /// one's (Engel, Kraus and Ertl 2001), which is right only for its opacity.
  std::optional<float> constant_length{};

  /// The same in every number.
  bool operator==(const TableSettings&) const = default;

  /// What is wrong, in one line with the value; nothing where all is well.
  std::optional<std::string> problem() const;
};

/// The lengths that a table should cover, {0, 0} where there is nothing to tabulate: the
/// `length_range` of its settings or what stands there.
std::array<float, 2> table_lengths(const TransferFunction& transfer_function,
                                   double mean_extinction,
                                   const std::optional<std::array<float, 2>>& length_range);

/// A pre-integrated table of first order, read with trilinear interpolation (bilinear where the
/// length is constant). Source: Roettger, Kraus and Ertl, "Hardware-Accelerated Volume and
/// Isosurface Rendering Based on Cell-Projection", Visualization 2000 (the third axis); Engel,
/// Kraus and Ertl, "High-Quality Pre-Integrated Volume Rendering", Graphics Hardware 2001 (two
/// axes). What an entry holds is in TableEntry.
///
/// Built incrementally, as by Lum, Wilson and Ma, "High-Quality Lighting and Efficient
/// Pre-Integration for Volume Rendering", VisSym 2004: all entries of one length whose scalars are
/// k steps apart are made of the same short segments, of one step each, so that an entry costs one
/// closed form between neighbouring scalars and three compositings, however many knots there are.
/// Sums over the windows of k steps come from prefixes and suffixes of blocks of k (van Herk 1992;
/// Gil and Werman 1993): nothing is divided out, so that opaque ranges lose no digits, and entries
/// are exact to the last bits of a float.
///
/// Error: of second order in the spacing of the table where the transfer function has no knot, and
/// of first order next to a step; there is no bound, for what lies between two entries, like a
/// narrow spike, is smeared over both. report() measures it. At the default size: 3e-3 at most and
/// 3e-4 RMS on eight knots without steps; up to 1 on long segments beside a step that ends an empty
/// range.
///
/// A segment shorter than the table's shortest takes the entry of the shortest, which is right to a
/// relative error of about its optical depth. Where the table does not reach, the closed form
/// answers: a scalar outside the range, a segment longer than the longest, and everything if the
/// range is empty or without extinction.
class PreintegratedTable {
 public:
  /// Requires !transfer_function.problem() and !settings.problem(). Runs on all threads that TBB
  /// has.
  explicit PreintegratedTable(const TransferFunction& transfer_function,
                              const TableSettings& settings = {});

  /// See SegmentIntegrator.
  SegmentColor integrate(float s_in, float s_out, float length) const;

  /// Not from the table: exact, as ClosedForm's. It differs from -log(1 - alpha) by the table's
  /// error.
  float optical_depth(float s_in, float s_out, float length) const {
    return closed_form_.optical_depth(s_in, s_out, length);
  }

  /// Memory, time to build, measured error.
  const TableReport& report() const { return report_; }
  /// Of the entries.
  std::size_t bytes() const { return report_.bytes; }

  /// Shortest and longest length that the table covers; {0, 0} where there is no table.
  std::array<float, 2> length_range() const { return {shortest_, longest_}; }

  /// Both axes of scalars, that of log2(length), and the entries, [(length * back count + back) *
  /// front count + front]: for who reads the table in another way. Empty where there is no table.
  const TableAxis& scalar_axis() const { return scalars_; }
  /// Of the logarithms of lengths.
  const TableAxis& length_axis() const { return lengths_; }
  /// Front scalars first, then back scalars, then lengths.
  const std::vector<TableEntry>& entries() const { return entries_; }

 private:
  void fill();
  void measure();

  ClosedForm closed_form_;
  OpticalDepth depth_;
  TableAxis scalars_;
  TableAxis lengths_;
  float shortest_ = 0;
  float longest_ = 0;
  /// The longest that is read from the table.
  float reach_ = 0;
  std::vector<TableEntry> entries_;
  TableReport report_;
};

static_assert(SegmentIntegrator<PreintegratedTable>);

}  // namespace plume
