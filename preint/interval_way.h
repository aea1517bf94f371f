/// The ways to cut rays at intervals and isosurfaces.
#pragma once

#include <cstdint>

namespace plume {

/// Where rays are cut at the ends of intervals and at isovalues.
enum class IntervalWay : std::uint8_t {
  split,  ///< in data space, exactly (IntervalState); the default
  table,  ///< in tables, before rendering (IntervalTable); to compare
};

/// What an IntervalTable is made of.
struct IntervalTableSettings {
  /// Entries along each axis of scalars, >= 2; the paper's are 256.
  int scalar_count = 256;
  /// Entries along the axis of lengths, which is logarithmic, >= 2.
  int length_count = 16;

  /// The same in every number.
  bool operator==(const IntervalTableSettings&) const = default;
};

}  // namespace plume
