#include "plume/tests/bench/packet_walker.h"

#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "hwy/targets.h"
#include "plume/lib/volume_packets.h"
#include "plume/traverse/packets.h"

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
    TetStart& start = finished ? starts_[static_cast<std::size_t>(
                                     static_cast<const TetStart*>(finished) - starts_.data())]
                               : starts_[used_++];
    set_start(start, mesh_.tets, frame_, mesh_.tets.boundary[passage.entry.boundary],
              passage.entry.place, passage.entry.rank, index);
    return &start;
  }

 private:
  const BenchMesh& mesh_;
  const BenchView& view_;
  const std::vector<std::uint32_t>& passages_;
  std::array<TetStart, kMaxPacketLanes> starts_;
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

void walk_packet_passages(const BenchMesh& mesh, const BenchView& view, Mode mode,
                          std::span<PassageSum> sums) {
  const auto passages = by_axis(view);
  // walk(axis, feeder) for the rays of each axis.
  auto for_each_axis = [&](auto&& walk) {
    for (int axis = 0; axis < 3; ++axis) {
      PassageFeeder feeder(mesh, view, passages[static_cast<std::size_t>(axis)]);
      walk(axis, feeder);
    }
  };
  if (mode == Mode::cells) {
    std::vector<std::uint32_t> counts(sums.size(), 0);
    for_each_axis(
        [&](int axis, PassageFeeder& feeder) { count_cells(mesh.tets, axis, feeder, counts); });
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = {counts[i], 0, 0};
  } else if (mode == Mode::integral) {
    std::vector<PacketIntegral> integrals(sums.size());
    for_each_axis([&](int axis, PassageFeeder& feeder) {
      integrate_scalar(mesh.tets, axis, feeder, integrals);
    });
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] = {integrals[i].cells, integrals[i].length, integrals[i].integral};
  } else if (mode == Mode::isosurface) {
    std::vector<PacketHit> hits(sums.size());
    for_each_axis([&](int axis, PassageFeeder& feeder) {
      find_isosurface(mesh.tets, axis, mesh.optics.isovalue, feeder, hits);
    });
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i] = {hits[i].cells, 0, 0};
      if (!std::isfinite(hits[i].distance)) continue;
      const Passage& passage = view.passages[i];
      ShearedFrame frame;
      frame.set(view.rays[passage.ray], mesh.tets.frame);
      sums[i].first = static_cast<float>(frame.t(passage.entry.place.z)) + hits[i].distance;
    }
  } else {
    assert(mode == Mode::closed_form);
    std::vector<PacketColor> colors(sums.size());
    for_each_axis([&](int axis, PassageFeeder& feeder) {
      composite_packets(mesh.tets, mesh.optics.pieces, axis, 0, feeder, colors);
    });
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] = {colors[i].cells, colors[i].transmittance, colors[i].r + colors[i].g + colors[i].b};
  }
}

void walk_packet_passages_avx2(const BenchMesh& mesh, const BenchView& view, Mode mode,
                               std::span<PassageSum> sums) {
  limit_packet_instruction_sets(HWY_AVX2);
  walk_packet_passages(mesh, view, mode, sums);
  limit_packet_instruction_sets(0);
}

bool packets_have_more_than_avx2() { return (hwy::SupportedTargets() & HWY_AVX3) != 0; }

}  // namespace plume::bench
