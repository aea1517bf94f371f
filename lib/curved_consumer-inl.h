// What compositing a volume above order 1 does with the segments of packets (see PacketWalk).
// Compiled once for each instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_LIB_CURVED_CONSUMER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_LIB_CURVED_CONSUMER_INL_H_
#undef PLUME_LIB_CURVED_CONSUMER_INL_H_
#else
#define PLUME_LIB_CURVED_CONSUMER_INL_H_
#endif
// clang-format on

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "hwy/highway.h"
#include "plume/lib/composite_by-inl.h"
#include "plume/lib/curved_packets.h"
#include "plume/lib/inner_consumer-inl.h"
#include "plume/lib/volume_consumer-inl.h"
#include "plume/preint/classified_form-inl.h"
#include "plume/preint/curved_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// With kInner scalars inside of each cell.
template <std::size_t kInner, class Mesh, class Pieces>
class CurvedConsumer final : public InnerConsumerOf<Mesh, VolumeConsumer<Pieces>> {
 public:
  CurvedConsumer(const VolumeConsumer<Pieces>& linear, const Mesh& mesh, int axis, float off_by)
      : InnerConsumerOf<Mesh, VolumeConsumer<Pieces>>(linear, mesh, axis), tolerance_(off_by) {}

  MF visit(std::size_t packet, MF active, VF length, VF s_in, VF s_out, VU cells) override {
    const DF d;
    VF inner[kInner];
    const MF curved = this->inside.template At<kInner>(packet, active, cells, inner);
    const optics::CurvedLanes<kInner> scalar(curved, s_in, s_out, inner);
    MF done = hn::MaskFromVec(hn::Zero(d));
    scalar.ForEachLinearPart(active, length, tolerance_, [&](MF on, VF from, VF to, VF part) {
      done = this->base.visit(packet, on, part, from, to, cells);
    });
    return done;
  }

 private:
  const float tolerance_;
};

// With cubics that follow the scalar inside of each cell (ScalarOrder::adaptive).
template <class Mesh, class Pieces>
class AdaptiveConsumer final : public InnerConsumerOf<Mesh, VolumeConsumer<Pieces>> {
 public:
  AdaptiveConsumer(const VolumeConsumer<Pieces>& linear, const Mesh& mesh, int axis, float off_by)
      : InnerConsumerOf<Mesh, VolumeConsumer<Pieces>>(linear, mesh, axis), tolerance_(off_by) {}

  MF visit(std::size_t packet, MF active, VF length, VF s_in, VF s_out, VU cells) override {
    MF done = hn::MaskFromVec(hn::Zero(DF()));
    this->inside.ForEachClosePart(
        packet, active, cells, s_in, s_out, tolerance_,
        [&](MF on, MF curved, VF from, VF to, VF s_from, VF s_to, const VF(&inner)[2]) {
          const optics::CurvedLanes<2> scalar(curved, s_from, s_to, inner);
          done = hn::Or(done, add(packet, on, hn::Mul(length, hn::Sub(to, from)), scalar));
          return done;
        });
    return done;
  }

 private:
  // Not inlined, as it is called from more than one place.
  HWY_NOINLINE MF add(std::size_t packet, MF on, VF length, const optics::CurvedLanes<2>& scalar) {
    MF done = hn::MaskFromVec(hn::Zero(DF()));
    scalar.ForEachLinearPart(on, length, tolerance_, [&](MF still, VF from, VF to, VF part) {
      done = this->base.visit(packet, still, part, from, to, hn::Zero(DU()));
    });
    return done;
  }

  const float tolerance_;
};

template <class Mesh>
void CompositeCurved(const Mesh& mesh, const CurvedPackets& packets, int axis,
                     PacketFeeder& feeder) {
  // Behind a transmittance of 1e-9 nothing changes a float between 0 and 1.
  const float enough = std::max(packets.early_termination, optics::kInvisible);
  const float tolerance = std::max(packets.tolerance, std::numeric_limits<float>::min());
  WithTable(packets.volume->pieces, [&](const auto& table) {
    using Table = std::decay_t<decltype(table)>;
    const VolumeConsumer<Table> linear{*packets.volume, table, nullptr, enough, packets.colors};
    auto walk = [&](InnerConsumer<Mesh>&& consumer) { Walk(mesh, axis, consumer, feeder); };
    if (packets.order == ScalarOrder::quadratic)
      walk(CurvedConsumer<1, Mesh, Table>(linear, mesh, axis, tolerance));
    else if (packets.order == ScalarOrder::cubic)
      walk(CurvedConsumer<2, Mesh, Table>(linear, mesh, axis, tolerance));
    else
      walk(AdaptiveConsumer<Mesh, Table>(linear, mesh, axis, tolerance));
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
