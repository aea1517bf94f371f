// What walks see of those that take segments above order 1. Compiled once for each instruction set:
// to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_LIB_INNER_CONSUMER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_LIB_INNER_CONSUMER_INL_H_
#undef PLUME_LIB_INNER_CONSUMER_INL_H_
#else
#define PLUME_LIB_INNER_CONSUMER_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "plume/traverse/inner_lanes-inl.h"
#include "plume/traverse/packet_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// A consumer (see PacketWalk) that knows the scalar inside of each cell. What it does with that
// takes far longer than a call through a pointer, so that all of them share one walk for each kind
// of cells: a walk for each mode, order and table would be the same code again, and minutes of
// compiling.
template <class Mesh>
class InnerConsumer {
 public:
  static constexpr bool kMeasure = true;

  InnerConsumer(const Mesh& mesh, int axis) : inside(mesh, axis) {}
  InnerConsumer(const InnerConsumer&) = delete;
  InnerConsumer& operator=(const InnerConsumer&) = delete;

  virtual void begin(std::size_t packet, std::size_t lane, const PacketStart& start) = 0;
  virtual MF visit(std::size_t packet, MF active, VF length, VF s_in, VF s_out, VU cells) = 0;
  virtual void end(std::size_t packet, std::size_t lane, const PacketStart& start, float z,
                   std::uint32_t cells) = 0;
  HWY_INLINE void ends_at(std::size_t packet, VF z) { inside.ends_at(packet, z); }

 protected:
  ~InnerConsumer() = default;

  InnerLanes<Mesh> inside;
};

// One that hands rays, and what it makes of their segments, on to a consumer of another kind.
template <class Mesh, class Base>
class InnerConsumerOf : public InnerConsumer<Mesh> {
 public:
  InnerConsumerOf(const Base& to, const Mesh& mesh, int axis)
      : InnerConsumer<Mesh>(mesh, axis), base(to) {}

  void begin(std::size_t packet, std::size_t lane, const PacketStart& start) final {
    base.begin(packet, lane, start);
    this->inside.begin(packet, lane, start);
  }
  void end(std::size_t packet, std::size_t lane, const PacketStart& start, float z,
           std::uint32_t cells) final {
    base.end(packet, lane, start, z, cells);
  }

 protected:
  ~InnerConsumerOf() = default;

  Base base;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
