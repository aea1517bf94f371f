#include "plume/tests/bench/packet_walker.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>
#include <vector>

#include "hwy/targets.h"
#include "plume/lib/volume_packets.h"
#include "plume/traverse/frame_lanes.h"
#include "plume/traverse/packets.h"

namespace plume::bench {
namespace {

// Passages of one axis, set up sixteen at a time: a renderer sets up those of a tile.
template <class Form>
class PassageFeeder : public PacketFeeder {
 public:
  using Start = StartOf<Form>;

  // `t_in`, where it is not empty, is set to where each passage begins.
  PassageFeeder(const Form& form, const BenchView& view, const std::vector<std::uint32_t>& passages,
                std::span<float> t_in)
      : form_(form), view_(view), passages_(passages), t_in_(t_in) {
    for (std::size_t place = 0; place < starts_.size(); ++place) free_.push_back(place);
  }

  const PacketStart* next(const PacketStart* finished) override {
    if (finished != nullptr)
      free_.push_back(static_cast<std::size_t>(static_cast<const Start*>(finished) - &starts_[0]));
    if (ready_.empty()) set_up();
    if (ready_.empty()) return nullptr;
    const std::size_t place = ready_.back();
    ready_.pop_back();
    return &starts_[place];
  }

 private:
  void set_up() {
    const std::size_t count = std::min(passages_.size() - at_, FrameLanes::kRays);
    const std::uint32_t* const numbers = passages_.data() + at_;
    at_ += count;
    RayLanes rays;
    for (std::size_t i = 0; i < count; ++i) rays.add(view_.rays[view_.passages[numbers[i]].ray]);
    ask_for_more();
    FrameLanes frames;
    frames.set(rays, form_.frame);
    for (std::size_t i = count; i-- > 0;) {
      const Entry& entry = view_.passages[numbers[i]].entry;
      const std::size_t place = free_.back();
      free_.pop_back();
      ready_.push_back(place);
      frames.put(i, frames_[place]);
      if (!t_in_.empty()) t_in_[numbers[i]] = static_cast<float>(frames_[place].t(entry.place.z));
      set_start(starts_[place], form_, frames_[place], form_.boundary[entry.boundary], entry.place,
                entry.rank, numbers[i]);
    }
  }

  // A renderer makes its rays and finds their entries; here they come from memory.
  void ask_for_more() const {
    const std::size_t far = std::min(passages_.size(), at_ + 2 * FrameLanes::kRays);
    for (std::size_t i = at_; i < far; ++i) {
      const Passage* const passage = &view_.passages[passages_[i]];
      if (i < at_ + FrameLanes::kRays)
        __builtin_prefetch(&view_.rays[passage->ray]);
      else
        __builtin_prefetch(passage);
    }
  }

  // Packets hold no more than kMaxPacketLanes at a time.
  static constexpr std::size_t kPlaces = kMaxPacketLanes + FrameLanes::kRays;

  const Form& form_;
  const BenchView& view_;
  const std::vector<std::uint32_t>& passages_;
  const std::span<float> t_in_;
  std::array<Start, kPlaces> starts_;
  std::array<ShearedFrame, kPlaces> frames_;  // starts of grids refer to theirs
  std::vector<std::size_t> free_, ready_;
  std::size_t at_ = 0;
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

template <class Form>
void walk_form(const Form& form, const BenchOptics& optics, const BenchView& view, Mode mode,
               std::span<PassageSum> sums) {
  const auto passages = by_axis(view);
  std::vector<float> t_in(mode == Mode::isosurface ? view.passages.size() : 0);
  // walk(axis, feeder) for the rays of each axis.
  auto for_each_axis = [&](auto&& walk) {
    for (int axis = 0; axis < 3; ++axis) {
      PassageFeeder<Form> feeder(form, view, passages[static_cast<std::size_t>(axis)], t_in);
      walk(axis, feeder);
    }
  };
  if (mode == Mode::cells) {
    std::vector<std::uint32_t> counts(sums.size(), 0);
    for_each_axis(
        [&](int axis, PassageFeeder<Form>& feeder) { count_cells(form, axis, feeder, counts); });
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = {counts[i], 0, 0};
  } else if (mode == Mode::integral) {
    std::vector<PacketIntegral> integrals(sums.size());
    for_each_axis([&](int axis, PassageFeeder<Form>& feeder) {
      integrate_scalar(form, axis, feeder, integrals);
    });
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] = {integrals[i].cells, integrals[i].length, integrals[i].integral};
  } else if (mode == Mode::isosurface) {
    std::vector<PacketHit> hits(sums.size());
    for_each_axis([&](int axis, PassageFeeder<Form>& feeder) {
      find_isosurface(form, axis, optics.isovalue, feeder, hits);
    });
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i] = {hits[i].cells, 0, 0};
      if (std::isfinite(hits[i].distance)) sums[i].first = t_in[i] + hits[i].distance;
    }
  } else {
    assert(mode == Mode::closed_form);
    std::vector<PacketColor> colors(sums.size());
    for_each_axis([&](int axis, PassageFeeder<Form>& feeder) {
      composite_packets(form, {&optics.pieces, nullptr, 0, colors}, axis, feeder);
    });
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] = {colors[i].cells, colors[i].transmittance, colors[i].r + colors[i].g + colors[i].b};
  }
}

}  // namespace

void walk_packet_passages(const BenchMesh& mesh, const BenchView& view, Mode mode,
                          std::span<PassageSum> sums) {
  if (mesh.family == Family::tetrahedra)
    walk_form(mesh.tets, mesh.optics, view, mode, sums);
  else if (mesh.family == Family::hexahedra)
    walk_form(mesh.grid, mesh.optics, view, mode, sums);
  else
    walk_form(mesh.cells, mesh.optics, view, mode, sums);
}

void walk_packet_passages_avx2(const BenchMesh& mesh, const BenchView& view, Mode mode,
                               std::span<PassageSum> sums) {
  limit_packet_instruction_sets(HWY_AVX2);
  walk_packet_passages(mesh, view, mode, sums);
  limit_packet_instruction_sets(0);
}

void walk_compact_passages(const BenchMesh& mesh, const BenchView& view, Mode mode,
                           std::span<PassageSum> sums) {
  walk_form(mesh.compact_tets, mesh.optics, view, mode, sums);
}

void walk_compact_passages_avx2(const BenchMesh& mesh, const BenchView& view, Mode mode,
                                std::span<PassageSum> sums) {
  limit_packet_instruction_sets(HWY_AVX2);
  walk_compact_passages(mesh, view, mode, sums);
  limit_packet_instruction_sets(0);
}

bool packets_have_more_than_avx2() { return (hwy::SupportedTargets() & HWY_AVX3) != 0; }

}  // namespace plume::bench
