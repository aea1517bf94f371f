/// Where rays come in, found sixteen at a time and one by one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plume/traverse/boundary.h"

namespace plume::test {

/// Rays of one mesh, in groups of one longest axis, as pictures have them.
template <class W>
class EntriesTogether {
 public:
  EntriesTogether(const typename W::Mesh& mesh, const BoundaryIndex<W>& boundary)
      : mesh_(mesh), boundary_(boundary) {}

  /// A ray whose frame that is. Returned are the numbers of those that come in elsewhere when they
  /// are looked at together: once there are sixteen of an axis.
  std::vector<std::uint64_t> add(const Ray& ray, const ShearedFrame& frame, std::uint64_t number) {
    Group& group = groups_[static_cast<std::size_t>(frame.axis())];
    const W walker(mesh_, frame);
    group.expected[group.rays.size] = boundary_.next_entries(walker, frame);
    group.numbers[group.rays.size] = number;
    group.rays.add(ray);
    return group.rays.size == RayLanes::kRays ? compare(group) : std::vector<std::uint64_t>{};
  }
  /// Those that are left.
  std::vector<std::uint64_t> finish() {
    std::vector<std::uint64_t> different;
    for (Group& group : groups_)
      for (const std::uint64_t number : compare(group)) different.push_back(number);
    return different;
  }

 private:
  struct Group {
    RayLanes rays;
    std::array<EntryList, RayLanes::kRays> expected;
    std::array<std::uint64_t, RayLanes::kRays> numbers{};
  };

  static bool same(const EntryList& a, const EntryList& b) {
    if (a.size != b.size || a.more != b.more) return false;
    for (std::uint32_t i = 0; i < a.size; ++i) {
      const Entry &p = a.entries[i], &q = b.entries[i];
      if (p.boundary != q.boundary || p.rank != q.rank || p.place.z != q.place.z ||
          p.place.scalar != q.place.scalar)
        return false;
    }
    return true;
  }

  std::vector<std::uint64_t> compare(Group& group) {
    FrameLanes frames;
    frames.set(group.rays, mesh_.frame);
    std::array<EntryList, RayLanes::kRays> found;
    boundary_.first_entries(frames, found);
    std::vector<std::uint64_t> different;
    for (std::size_t i = 0; i < group.rays.size; ++i)
      if (!same(found[i], group.expected[i])) different.push_back(group.numbers[i]);
    group.rays.size = 0;
    return different;
  }

  const typename W::Mesh& mesh_;
  const BoundaryIndex<W>& boundary_;
  std::array<Group, 3> groups_;  // by axis
};

}  // namespace plume::test
