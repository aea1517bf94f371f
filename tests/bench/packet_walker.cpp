#include "plume/tests/bench/packet_walker.h"

#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "plume/traverse/tet_packets.h"

namespace plume::bench {
namespace {

// Passages of one axis; a lane's start is made when it is asked for, as in a renderer.
class PassageFeeder : public PacketFeeder {
 public:
  PassageFeeder(const BenchMesh& mesh, const BenchView& view,
                const std::vector<std::uint32_t>& passages)
      : mesh_(mesh), view_(view), passages_(passages) {}

  const PacketStart* next(const PacketStart* finished) override {
    if (at_ == passages_.size()) return nullptr;
    const std::uint32_t index = passages_[at_++];
    const Passage& passage = view_.passages[index];
    frame_.set(view_.rays[passage.ray], mesh_.tets.frame);
    // A lane's place is free again when its ray has finished.
    PacketStart& start =
        finished ? starts_[static_cast<std::size_t>(finished - starts_.data())] : starts_[used_++];
    set_start(start, mesh_.tets, frame_, mesh_.tets.boundary[passage.entry.boundary],
              passage.entry.place, index);
    return &start;
  }

 private:
  const BenchMesh& mesh_;
  const BenchView& view_;
  const std::vector<std::uint32_t>& passages_;
  std::array<PacketStart, kMaxPacketLanes> starts_;
  std::size_t used_ = 0;
  std::size_t at_ = 0;
  ShearedFrame frame_;
};

// The passages of each axis.
std::array<std::vector<std::uint32_t>, 3> by_axis(const BenchView& view) {
  std::array<std::vector<std::uint32_t>, 3> passages;
  for (std::uint32_t i = 0; i < view.passages.size(); ++i) {
    const auto& d = view.rays[view.passages[i].ray].direction;
    passages[static_cast<std::size_t>(longest_axis(d))].push_back(i);
  }
  return passages;
}

}  // namespace

void walk_packet_passages(const BenchMesh& mesh, const BenchView& view, [[maybe_unused]] Mode mode,
                          std::span<PassageSum> sums) {
  assert(mode == Mode::cells);
  std::vector<std::uint32_t> counts(sums.size(), 0);
  const auto passages = by_axis(view);
  for (int axis = 0; axis < 3; ++axis) {
    PassageFeeder feeder(mesh, view, passages[static_cast<std::size_t>(axis)]);
    count_cells(mesh.tets, axis, feeder, counts);
  }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = {counts[i], 0, 0};
}

}  // namespace plume::bench
