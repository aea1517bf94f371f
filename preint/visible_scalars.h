/// Which values of the scalar a classification shows anything of.
#pragma once

#include <span>
#include <vector>

#include "plume/preint/classification.h"

namespace plume {

/// Immutable; safe to share between threads.
class VisibleScalars {
 public:
  /// A closed range.
  struct Range {
    float low, high;
  };

  /// Of everything: where the volume's extinction is not zero, intervals, isosurfaces. Requires
  /// !classification.problem().
  explicit VisibleScalars(const Classification& classification);
  /// Of a volume alone. Requires !volume.problem().
  explicit VisibleScalars(const TransferFunction& volume);

  /// Ascending, and apart from each other.
  std::span<const Range> ranges() const { return ranges_; }
  /// Whether anything may be seen of scalars between the two; true where one is NaN.
  bool meet(float least, float greatest) const {
    for (const Range& range : ranges_)
      if (!(greatest < range.low) && !(least > range.high)) return true;
    return false;
  }

 private:
  void add(const TransferFunction& volume);
  void merge();

  std::vector<Range> ranges_;
};

}  // namespace plume
