#include "plume/tests/bench/packet_walker.h"

#include <cassert>
#include <vector>

#include "plume/traverse/tet_packets.h"
#include "plume/traverse/tet_walker.h"

namespace plume::bench {
namespace {

// Passages of one axis; a lane's start is made when it is asked for, as in a renderer.
class PassageFeeder : public PacketFeeder {
 public:
  PassageFeeder(const BenchMesh& mesh, const BenchView& view, int axis)
      : mesh_(mesh), view_(view), axis_(axis), starts_(view.passages.size()) {}

  const PacketStart* next(const PacketStart*) override {
    while (at_ < view_.passages.size()) {
      const std::size_t index = at_++;
      const Passage& passage = view_.passages[index];
      ShearedFrame frame;
      frame.set(view_.rays[passage.ray], mesh_.tets.frame);
      if (frame.axis() != axis_) continue;
      TetWalker walker(mesh_.tets, frame);
      walker.enter(mesh_.tets.boundary[passage.entry.boundary], passage.entry.rank);
      starts_[index] = walker.packet_start(passage.entry.place, static_cast<std::uint32_t>(index));
      return &starts_[index];
    }
    return nullptr;
  }

 private:
  const BenchMesh& mesh_;
  const BenchView& view_;
  const int axis_;
  std::vector<PacketStart> starts_;
  std::size_t at_ = 0;
};

}  // namespace

void walk_packet_passages(const BenchMesh& mesh, const BenchView& view, [[maybe_unused]] Mode mode,
                          std::span<PassageSum> sums) {
  assert(mode == Mode::cells);
  std::vector<std::uint32_t> counts(sums.size(), 0);
  for (int axis = 0; axis < 3; ++axis) {
    PassageFeeder feeder(mesh, view, axis);
    count_cells(mesh.tets, axis, feeder, counts);
  }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = {counts[i], 0, 0};
}

}  // namespace plume::bench
