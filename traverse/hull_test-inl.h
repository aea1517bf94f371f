// Bundles of rays against boxes that lie side by side. Compiled once for each instruction set: to
// be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_HULL_TEST_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_HULL_TEST_INL_H_
#undef PLUME_TRAVERSE_HULL_TEST_INL_H_
#else
#define PLUME_TRAVERSE_HULL_TEST_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "plume/traverse/ray_bundle.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// What several rays of a bundle lie in, against boxes that lie side by side.
class HullTest {
 public:
  HullTest() = default;
  HullTest(const RayBundle& bundle, const RayBundle::Hull& hull)
      : hull_(hull),
        x_(static_cast<std::size_t>((bundle.axis() + 1) % 3)),
        y_(static_cast<std::size_t>((bundle.axis() + 2) % 3)),
        z_(static_cast<std::size_t>(bundle.axis())) {}

  // Rounding moves a face against a ray, and the hull, by less than 3e-6 (see boundary.cpp).
  static constexpr float kMargin = 0x1p-17f;

  // Boxes `from` and following: false for those that no ray goes through.
  template <class D, std::size_t kBoxes>
  HWY_INLINE hn::Mask<D> Meets(D d, const float (&lows)[3][kBoxes], const float (&highs)[3][kBoxes],
                               std::size_t from) const {
    const auto z_low = hn::Load(d, lows[z_] + from), z_high = hn::Load(d, highs[z_] + from);
    auto at = [&](const RayBundle::Line& line, hn::Vec<D> z) HWY_ATTR {
      return hn::MulAdd(hn::Set(d, line.slope), z, hn::Set(d, line.offset));
    };
    auto along = [&](std::size_t axis, const RayBundle::Line& least,
                     const RayBundle::Line& greatest) HWY_ATTR {
      const auto low = hn::Sub(hn::Load(d, lows[axis] + from), hn::Set(d, kMargin));
      const auto high = hn::Add(hn::Load(d, highs[axis] + from), hn::Set(d, kMargin));
      return hn::And(hn::Le(hn::Min(at(least, z_low), at(least, z_high)), high),
                     hn::Ge(hn::Max(at(greatest, z_low), at(greatest, z_high)), low));
    };
    return hn::And(along(x_, hull_.least_x, hull_.greatest_x),
                   along(y_, hull_.least_y, hull_.greatest_y));
  }

  // The rays' longest.
  std::size_t axis() const { return z_; }

 private:
  RayBundle::Hull hull_{};
  std::size_t x_ = 0, y_ = 0, z_ = 0;
};

template <class D>
HWY_INLINE std::uint32_t BitsOf(D d, hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
