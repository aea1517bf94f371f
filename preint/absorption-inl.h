// What a stretch of linear optics absorbs, and what its emission weighs. Compiled once for each
// instruction set: to be included after hwy/foreach_target.h alone.
//
// With m its optical depth and d half of the difference between the depths that its back and its
// front optics would give alone, for m <= 2 and |d| <= m:
//     alpha = 1 - exp(-m) = m A(m)
//     chi = psi - exp(-m) = m X0(m) + d X1(m) + d^2 X2(m) + ... + d^7 X7(m)
// as the transparency so far is exp(-m u) exp(d u (1 - u)), of which the second factor is expanded.
// Fitted at Chebyshev nodes: A to 1e-9 relative, chi to 9e-8 absolute. Lanes whose m is at most 1
// are given shorter ones: A to 2e-9, chi (up to d^5) to 8e-8. Those whose m is at most 1/4, in most
// meshes nearly all, the shortest: A to 3e-9, chi (up to d^4) to 5e-8.

// clang-format off
#if defined(PLUME_PREINT_ABSORPTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_PREINT_ABSORPTION_INL_H_
#undef PLUME_PREINT_ABSORPTION_INL_H_
#else
#define PLUME_PREINT_ABSORPTION_INL_H_
#endif
// clang-format on

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {
namespace optics {

namespace hn = hwy::HWY_NAMESPACE;

using DF = HWY_CAPPED(float, 16);
using DU = hn::RebindToUnsigned<DF>;
using DI = hn::RebindToSigned<DF>;
using VF = hn::Vec<DF>;
using VU = hn::Vec<DU>;
using MF = hn::Mask<DF>;

// Up to which optical depth the shortest polynomials serve.
constexpr float kNear = 0.25f;

HWY_INLINE VF Horner(VF x, float c0) {
  (void)x;
  return hn::Set(DF(), c0);
}
// c0 + c1 x + c2 x^2 + ...
template <class... C>
HWY_INLINE VF Horner(VF x, float c0, C... more) {
  return hn::MulAdd(Horner(x, more...), x, hn::Set(DF(), c0));
}

// 1 - exp(-m) for m in [0, kNear].
HWY_INLINE VF AbsorbedNear(VF m) {
  return hn::Mul(m, Horner(m, 9.999999976e-01f, -4.999995148e-01f, 1.666510821e-01f,
                           -4.149065410e-02f, 7.513606222e-03f));
}

// psi - exp(-m) for m in [0, kNear], |d| <= m.
HWY_INLINE VF ChiNear(VF m, VF d) {
  const VF x0 = Horner(m, 4.999998054e-01f, -3.333083856e-01f, 1.244973914e-01f, -3.005720535e-02f);
  const VF x1 = Horner(m, 1.666666386e-01f, -8.332973194e-02f, 2.492751179e-02f, -5.084150682e-03f);
  const VF x2 = Horner(m, 1.666643902e-02f, -8.316904688e-03f, 2.203357911e-03f);
  const VF x3 = Horner(m, 1.189246844e-03f, -5.556506269e-04f);
  // Two short chains in the place of a long one.
  const VF dd = hn::Mul(d, d);
  const VF low = hn::MulAdd(x1, d, hn::Mul(x0, m));
  const VF high = hn::MulAdd(hn::MulAdd(hn::Set(DF(), 6.214152609e-05f), d, x3), d, x2);
  return hn::MulAdd(high, dd, low);
}

// 1 - exp(-m) for m in [0, 1].
HWY_INLINE VF Absorbed(VF m) {
  return hn::Mul(m,
                 Horner(m, 9.999999979e-01f, -4.999997973e-01f, 1.666634031e-01f, -4.164684931e-02f,
                        8.275504845e-03f, -1.300774959e-03f, 1.290763106e-04f));
}

// psi - exp(-m) for m in [0, 1], |d| <= m.
HWY_INLINE VF Chi(VF m, VF d) {
  const VF x0 = Horner(m, 4.999999982e-01f, -3.333331540e-01f, 1.249971129e-01f, -3.331579905e-02f,
                       6.893263273e-03f, -1.112450202e-03f, 1.121481829e-04f);
  const VF x1 = Horner(m, 1.666666599e-01f, -8.333284789e-02f, 2.499428835e-02f, -5.530755573e-03f,
                       9.426105211e-04f, -1.016378370e-04f);
  const VF x2 = Horner(m, 1.666664986e-02f, -8.332490790e-03f, 2.374123241e-03f, -4.763509607e-04f,
                       5.870130521e-05f);
  const VF x3 = Horner(m, 1.190444501e-03f, -5.942196611e-04f, 1.601330927e-04f, -2.423962708e-05f);
  const VF x4 = Horner(m, 6.609377066e-05f, -3.227347494e-05f, 6.789842466e-06f);
  const VF x5 = Horner(m, 2.964161757e-06f, -1.158061818e-06f);
  VF sum = hn::MulAdd(x5, d, x4);
  sum = hn::MulAdd(sum, d, x3);
  sum = hn::MulAdd(sum, d, x2);
  sum = hn::MulAdd(sum, d, x1);
  return hn::MulAdd(sum, d, hn::Mul(x0, m));
}

// 1 - exp(-m) for m in [0, 2].
HWY_INLINE VF AbsorbedFarther(VF m) {
  return hn::Mul(m, Horner(m, 9.999999995e-01f, -4.999999606e-01f, 1.666661380e-01f,
                           -4.166392097e-02f, 8.326138674e-03f, -1.378184669e-03f, 1.888878189e-04f,
                           -1.968693803e-05f, 1.148025996e-06f));
}

// psi - exp(-m) for m in [0, 2], |d| <= m.
HWY_INLINE VF ChiFarther(VF m, VF d) {
  const VF x0 = Horner(m, 4.999999996e-01f, -3.333332977e-01f, 1.249995226e-01f, -3.333085395e-02f,
                       6.937946388e-03f, -1.180805539e-03f, 1.650018808e-04f, -1.741917869e-05f,
                       1.023611181e-06f);
  const VF x1 = Horner(m, 1.666666658e-01f, -8.333327825e-02f, 2.499941713e-02f, -5.553188422e-03f,
                       9.872938196e-04f, -1.435024139e-04f, 1.591221117e-05f, -9.971479238e-07f);
  const VF x2 = Horner(m, 1.666666544e-02f, -8.333273154e-03f, 2.380465807e-03f, -4.945408448e-04f,
                       8.046129416e-05f, -9.840097438e-06f, 6.792967449e-07f);
  const VF x3 = Horner(m, 1.190474788e-03f, -5.951874622e-04f, 1.650439589e-04f, -3.240814560e-05f,
                       4.584000514e-06f, -3.597877008e-07f);
  const VF x4 = Horner(m, 6.613629427e-05f, -3.303683614e-05f, 8.887799123e-06f, -1.560166198e-06f,
                       1.454143869e-07f);
  const VF x5 = Horner(m, 3.005356531e-06f, -1.488663272e-06f, 3.669013556e-07f, -4.339337153e-08f);
  const VF x6 = Horner(m, 1.151494714e-07f, -5.345672262e-08f, 9.024000355e-09f);
  const VF x7 = Horner(m, 3.673825703e-09f, -1.169713532e-09f);
  VF sum = hn::MulAdd(x7, d, x6);
  sum = hn::MulAdd(sum, d, x5);
  sum = hn::MulAdd(sum, d, x4);
  sum = hn::MulAdd(sum, d, x3);
  sum = hn::MulAdd(sum, d, x2);
  sum = hn::MulAdd(sum, d, x1);
  return hn::MulAdd(sum, d, hn::Mul(x0, m));
}

struct Absorption {
  VF taken;  // 1 - exp(-m)
  VF chi;
};
// Where some m are above kNear. Not inlined: the less code a step has, the better.
inline HWY_NOINLINE Absorption AbsorbFarther(VF m, VF difference) {
  const DF d;
  const MF farther = hn::Gt(m, hn::Set(d, kNear));
  const MF far = hn::Gt(m, hn::Set(d, 1.0f));
  Absorption absorption{Absorbed(m), Chi(m, difference)};
  if (!hn::AllTrue(d, farther)) {
    absorption = {hn::IfThenElse(farther, absorption.taken, AbsorbedNear(m)),
                  hn::IfThenElse(farther, absorption.chi, ChiNear(m, difference))};
  }
  if (!hn::AllFalse(d, far)) {
    absorption = {hn::IfThenElse(far, AbsorbedFarther(m), absorption.taken),
                  hn::IfThenElse(far, ChiFarther(m, difference), absorption.chi)};
  }
  return absorption;
}

// For m in [0, 2], |d| <= m. Which polynomials a lane is given depends on that lane alone: a ray
// looks the same whatever rays share its packet. `any_farther`: whether any m is above kNear.
HWY_INLINE Absorption Absorb(VF m, VF difference, bool any_farther) {
  if (HWY_LIKELY(!any_farther)) return {AbsorbedNear(m), ChiNear(m, difference)};
  return AbsorbFarther(m, difference);
}

}  // namespace optics
}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
