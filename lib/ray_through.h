/// What a ray meets of one mesh among several.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "plume/traverse/segment.h"
#include "plume/traverse/trace.h"

namespace plume {

/// A stretch of a ray, in world units along it.
struct RayRange {
  double from, to;
};

/// A ray's segments in a mesh, front to back, and the passages that they make up.
struct RayThrough {
  std::vector<Segment> segments;
  /// Ascending; what lies between two is longer than the gap.
  std::vector<RayRange> passages;

  void clear() {
    segments.clear();
    passages.clear();
  }

  /// A segment behind those before it. Those no farther apart than `gap` are one passage.
  void add(const Segment& segment, double gap) {
    segments.push_back(segment);
    if (!passages.empty() && segment.t_in - passages.back().to <= gap)
      passages.back().to = std::max(passages.back().to, segment.t_out);
    else
      passages.push_back({segment.t_in, segment.t_out});
  }
};

/// Calls visit(const RayRange&) for each stretch longer than `gap` that lies in a range of either
/// list; both ascend.
template <class Visit>
void for_each_overlap(std::span<const RayRange> a, std::span<const RayRange> b, double gap,
                      Visit&& visit) {
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const RayRange both{std::max(a[i].from, b[j].from), std::min(a[i].to, b[j].to)};
    if (both.to - both.from > gap) visit(both);
    ++(a[i].to < b[j].to ? i : j);
  }
}

/// Leaves out what lies in ascending ranges. A segment that reaches beyond one is cut there.
inline void leave_out(RayThrough& through, std::span<const RayRange> ranges, double gap) {
  const std::vector<Segment> all = std::move(through.segments);
  through.clear();
  for (const Segment& segment : all) {
    double from = segment.t_in;
    bool hidden = false;
    for (const RayRange& range : ranges) {
      if (range.to <= from) continue;
      if (range.from > segment.t_out) break;
      hidden = true;
      if (range.from > from) {
        Segment part = segment;
        cut(part, from, range.from);
        through.add(part, gap);
      }
      from = range.to;
    }
    if (!hidden) {
      through.add(segment, gap);
    } else if (from < segment.t_out) {
      Segment part = segment;
      cut(part, from, segment.t_out);
      through.add(part, gap);
    }
  }
}

/// Adds ranges to ascending ones; those that meet become one.
inline void join(std::vector<RayRange>& ranges, std::span<const RayRange> more) {
  ranges.insert(ranges.end(), more.begin(), more.end());
  std::sort(ranges.begin(), ranges.end(),
            [](const RayRange& a, const RayRange& b) { return a.from < b.from; });
  std::size_t kept = 0;
  for (const RayRange& range : ranges)
    if (kept > 0 && range.from <= ranges[kept - 1].to)
      ranges[kept - 1].to = std::max(ranges[kept - 1].to, range.to);
    else
      ranges[kept++] = range;
  ranges.resize(kept);
}

}  // namespace plume
