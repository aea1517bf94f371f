// Vectors of doubles, up to eight. Compiled once for each instruction set: to be included after
// hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_DOUBLE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_DOUBLE_LANES_INL_H_
#undef PLUME_TRAVERSE_DOUBLE_LANES_INL_H_
#else
#define PLUME_TRAVERSE_DOUBLE_LANES_INL_H_
#endif
// clang-format on

#include <cstdint>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using DD = HWY_CAPPED(double, 8);
using VD = hn::Vec<DD>;
using MD = hn::Mask<DD>;

// A bit for each lane, of sixteen at the most, of which that is true.
template <class D>
HWY_INLINE unsigned BitsOf(D d, hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return bytes[0] | static_cast<unsigned>(bytes[1]) << 8;
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
