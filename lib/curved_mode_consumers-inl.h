// What the modes that show one number a ray do with the segments of packets above order 1. Compiled
// once for each instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_LIB_CURVED_MODE_CONSUMERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_LIB_CURVED_MODE_CONSUMERS_INL_H_
#undef PLUME_LIB_CURVED_MODE_CONSUMERS_INL_H_
#else
#define PLUME_LIB_CURVED_MODE_CONSUMERS_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <type_traits>
#include <utility>

#include "hwy/highway.h"
#include "plume/lib/inner_consumer-inl.h"
#include "plume/lib/mode_consumers-inl.h"
#include "plume/preint/curved_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// A mode's consumer that is given polynomials, with kInner scalars inside of each cell.
template <std::size_t kInner, class Mesh, class Base>
class CurvedMode final : public InnerConsumerOf<Mesh, Base> {
 public:
  using InnerConsumerOf<Mesh, Base>::InnerConsumerOf;

  MF visit(std::size_t packet, MF active, VF way, VF s_in, VF s_out, VU cells) override {
    VF inner[kInner];
    const MF curved = this->inside.template At<kInner>(packet, active, cells, inner);
    const optics::CurvedLanes<kInner> scalar(curved, s_in, s_out, inner);
    if constexpr (requires(Base base) { base.ends_at(packet, way); })
      this->base.ends_at(packet, this->inside.EndsAt(packet));
    return this->base.visit_curved(packet, active, way, s_in, s_out, scalar);
  }
};

// ... given cubics that follow the scalar inside of each cell (ScalarOrder::adaptive).
template <class Mesh, class Base>
class AdaptiveMode final : public InnerConsumerOf<Mesh, Base> {
 public:
  using InnerConsumerOf<Mesh, Base>::InnerConsumerOf;

  MF visit(std::size_t packet, MF active, VF way, VF s_in, VF s_out, VU cells) override {
    MF done = NoLanes();
    this->inside.ForEachClosePart(
        packet, active, cells, s_in, s_out, this->base.packets.tolerance,
        [&](MF on, MF curved, VF from, VF to, VF s_from, VF s_to, const VF(&inner)[2]) {
          done = hn::Or(done, add(packet, hn::AndNot(done, on), curved,
                                  hn::Mul(way, hn::Sub(to, from)), to, s_from, s_to, inner));
          return done;
        });
    return done;
  }

 private:
  // Not inlined, as it is called from more than one place.
  HWY_NOINLINE MF add(std::size_t packet, MF on, MF curved, VF way, VF to, VF s_from, VF s_to,
                      const VF (&inner)[2]) {
    if constexpr (requires(Base base) { base.ends_at(packet, way); })
      this->base.ends_at(packet, this->inside.Z(packet, to));
    const optics::CurvedLanes<2> scalar(curved, s_from, s_to, inner);
    return this->base.visit_curved(packet, on, way, s_from, s_to, scalar);
  }
};

template <class Mesh>
void ReduceCurved(const Mesh& mesh, const ModePackets& packets, int axis, PacketFeeder& feeder) {
  ReduceBy<false>(packets, {}, [&](const auto& base) {
    using Base = std::decay_t<decltype(base)>;
    auto walk = [&](InnerConsumer<Mesh>&& consumer) { Walk(mesh, axis, consumer, feeder); };
    if (packets.order == ScalarOrder::quadratic)
      walk(CurvedMode<1, Mesh, Base>(base, mesh, axis));
    else if (packets.order == ScalarOrder::cubic)
      walk(CurvedMode<2, Mesh, Base>(base, mesh, axis));
    else
      walk(AdaptiveMode<Mesh, Base>(base, mesh, axis));
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
