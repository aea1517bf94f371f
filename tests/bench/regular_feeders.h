/// Rays for packets through a regular grid, and through the same grid taken as hexahedra.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "plume/traverse/boundary.h"
#include "plume/traverse/grid_walker.h"
#include "plume/traverse/rectilinear_start.h"

namespace plume::bench {

/// Rays of any axes, each set up when a lane asks for one, as in a renderer. Refers to its
/// arguments.
class RegularFeeder : public PacketFeeder {
 public:
  RegularFeeder(const WalkableRectilinear& mesh, const std::vector<Ray>& rays)
      : rays_(rays), lanes_(mesh) {}

  const PacketStart* next(const PacketStart* finished) override {
    const std::size_t place = lanes_.place(finished);
    while (at_ < rays_.size()) {
      const std::size_t ray = at_++;
      if (lanes_.set(place, rays_[ray], static_cast<std::uint32_t>(ray)) == RectilinearRay::ready)
        return lanes_.start(place);
    }
    return nullptr;
  }

 private:
  const std::vector<Ray>& rays_;
  RectilinearLanes lanes_;
  std::size_t at_ = 0;
};

/// The first passages of rays of one axis, found together when this is made. Refers to the mesh.
class HexahedraFeeder : public PacketFeeder {
 public:
  HexahedraFeeder(const WalkableGrid& mesh, const BoundaryIndex<GridWalker>& boundary,
                  const std::vector<Ray>& rays)
      : mesh_(mesh), frames_(rays.size()), entries_(rays.size()) {
    RayLanes lanes;
    FrameLanes frames;
    std::array<EntryList, FrameLanes::kRays> found;
    for (std::size_t begin = 0; begin < rays.size(); begin += FrameLanes::kRays) {
      lanes.size = 0;
      const std::size_t end = std::min(begin + FrameLanes::kRays, rays.size());
      for (std::size_t i = begin; i < end; ++i) lanes.add(rays[i]);
      frames.set(lanes, mesh.frame);
      boundary.first_entries(frames, found);
      for (std::size_t i = begin; i < end; ++i) {
        frames.put(i - begin, frames_[i]);
        entries_[i] = found[i - begin];
      }
    }
  }
  HexahedraFeeder(const HexahedraFeeder&) = delete;
  HexahedraFeeder& operator=(const HexahedraFeeder&) = delete;

  const PacketStart* next(const PacketStart* finished) override {
    while (at_ < frames_.size() && entries_[at_].size == 0) ++at_;
    if (at_ == frames_.size()) return nullptr;
    GridStart& start = finished ? starts_[static_cast<std::size_t>(
                                      static_cast<const GridStart*>(finished) - starts_.data())]
                                : starts_[used_++];
    const Entry& entry = entries_[at_].entries[0];
    set_start(start, mesh_, frames_[at_], mesh_.boundary[entry.boundary], entry.place, entry.rank,
              static_cast<std::uint32_t>(at_));
    ++at_;
    return &start;
  }

 private:
  const WalkableGrid& mesh_;
  std::vector<ShearedFrame> frames_;  // starts refer to them
  std::vector<EntryList> entries_;
  std::array<GridStart, kMaxPacketLanes> starts_;
  std::size_t used_ = 0, at_ = 0;
};

}  // namespace plume::bench
