// The triangles by which the lanes' rays come into tetrahedra, and where they cross them. Compiled
// once for each instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_TET_CORNERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_TET_CORNERS_INL_H_
#undef PLUME_TRAVERSE_TET_CORNERS_INL_H_
#else
#define PLUME_TRAVERSE_TET_CORNERS_INL_H_
#endif
// clang-format on

#include <cstdint>

#include "hwy/highway.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/packet_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

struct LaneCorners {
  HWY_ALIGN float x[kMaxLanes];
  HWY_ALIGN float y[kMaxLanes];
  HWY_ALIGN float z[kMaxLanes];
  HWY_ALIGN float s[kMaxLanes];
  HWY_ALIGN std::uint32_t id[kMaxLanes];
  HWY_ALIGN float across[kMaxLanes];
};

// A corner of the triangle by which the lanes' rays come into their cells. Where nothing is
// measured, z and s are left alone.
template <bool kMeasure>
struct Corner {
  VF x, y, z, s;
  VU id;

  HWY_INLINE void Load(const LaneCorners& from) {
    const DF d;
    x = hn::Load(d, from.x);
    y = hn::Load(d, from.y);
    if constexpr (kMeasure) {
      z = hn::Load(d, from.z);
      s = hn::Load(d, from.s);
    }
    id = hn::Load(DU(), from.id);
  }
  HWY_INLINE void Store(LaneCorners& to) const {
    const DF d;
    hn::Store(x, d, to.x);
    hn::Store(y, d, to.y);
    if constexpr (kMeasure) {
      hn::Store(z, d, to.z);
      hn::Store(s, d, to.s);
    }
    hn::Store(id, DU(), to.id);
  }
  // Takes another's place in the lanes whose bit is set.
  HWY_INLINE void Replace(VF bits, const Corner& other) {
    x = Choose(bits, other.x, x);
    y = Choose(bits, other.y, y);
    if constexpr (kMeasure) {
      z = Choose(bits, other.z, z);
      s = Choose(bits, other.s, s);
    }
    id = Choose(bits, other.id, id);
  }
};

// Where rays cross the triangle a, b, c: measure_triangle() in single precision, between the places
// where two of its edges cross y = 0. No bound on one crossing has been measured; sums of lengths
// are held against the twin's in tests/traverse/packets_test.cpp.
HWY_INLINE void MeasureBetweenEdges(const Corner<true>& a, const Corner<true>& b,
                                    const Corner<true>& c, StepResult& result) {
  const DF d;
  const VF ab = hn::Xor(a.y, b.y), ac = hn::Xor(a.y, c.y);  // on different sides of y = 0
  const VF lone_b = hn::AndNot(ac, ab), lone_c = hn::AndNot(ab, ac);
  Corner<true> lone = a, p = b, q = c;
  auto place = [&](VF Corner<true>::*of) {
    lone.*of = Choose(lone_b, b.*of, Choose(lone_c, c.*of, a.*of));
    p.*of = Choose(lone_b, a.*of, b.*of);
    q.*of = Choose(lone_c, a.*of, c.*of);
  };
  place(&Corner<true>::x);
  place(&Corner<true>::y);
  place(&Corner<true>::z);
  place(&Corner<true>::s);
  const VF p_height = hn::Sub(p.y, lone.y), q_height = hn::Sub(q.y, lone.y);
  VF p_distance = hn::Abs(DifferenceOfProducts(lone.x, p.y, p.x, lone.y));
  VF q_distance = hn::Abs(DifferenceOfProducts(lone.x, q.y, q.x, lone.y));
  // Only their ratio counts: brought to about 1 by a power of two, so that no product of three
  // coordinates underflows.
  const DU du;
  const VU exponent =
      hn::And(hn::BitCast(du, hn::Max(p_distance, q_distance)), hn::Set(du, 0x7F800000u));
  const VF scale = hn::BitCast(d, hn::Sub(hn::Set(du, 0x7F000000u), exponent));
  p_distance = hn::Mul(p_distance, scale);
  // If both edges pass through the ray, one of them will do.
  q_distance = hn::Max(hn::Mul(q_distance, scale), hn::Set(d, 1e-30f));
  const VF share = hn::Div(lone.y, hn::MulAdd(p_distance, q_height, hn::Mul(q_distance, p_height)));
  const VF of_p = hn::Mul(q_distance, share), of_q = hn::Mul(p_distance, share);  // negative
  result.z =
      hn::NegMulAdd(of_p, hn::Sub(p.z, lone.z), hn::NegMulAdd(of_q, hn::Sub(q.z, lone.z), lone.z));
  result.s =
      hn::NegMulAdd(of_p, hn::Sub(p.s, lone.s), hn::NegMulAdd(of_q, hn::Sub(q.s, lone.s), lone.s));
}

// The edges across from a triangle's corners, by the products (twice the areas) that they span with
// the ray; their signs are the bits that say whether the edges cross y = 0 on the ray's right. No
// numbers are those of edges so close to the ray that rounding decided on which side.
struct Across {
  VF a, b, c;
};

// All bits of a lane as that of its sign.
HWY_INLINE VF AllBits(VF bits) {
  return hn::BitCast(DF(), hn::BroadcastSignBit(hn::BitCast(hn::RebindToSigned<DF>(), bits)));
}

#if HWY_NATIVE_FMA

constexpr bool kByWeights = true;

// For the few that products say nothing of, as the ray lies in their planes or is next to it.
inline HWY_NOINLINE void MeasureEdgeOn(Corner<true> a, Corner<true> b, Corner<true> c,
                                       StepResult& result) {
  MeasureBetweenEdges(a, b, c, result);
}

// The same by corners' weights: as the triangle winds about the ray they are the products' sizes,
// all of one sign. That takes products that do not cancel, and whose signs are those that decided:
// of triangles next to edge-on all products are next to 0, and with a wrong one they would be
// crossed anywhere (an error of 0.2 of a cell was met).
HWY_INLINE void Measure(const Corner<true>& a, const Corner<true>& b, const Corner<true>& c,
                        const Across& across, StepResult& result) {
  const DF d;
  constexpr float kEdgeOn = 0x1p-96f;  // below, what products lose by rounding underflows
  const VF of_b = hn::Abs(across.b), of_c = hn::Abs(across.c);
  const VF sum = hn::Add(hn::Abs(across.a), hn::Add(of_b, of_c));
  const VF share = hn::Div(hn::Set(d, 1.0f), sum);
  auto place = [&](VF Corner<true>::*of) {
    const VF of_all = hn::MulAdd(of_b, hn::Sub(b.*of, a.*of), hn::Mul(of_c, hn::Sub(c.*of, a.*of)));
    return hn::MulAdd(of_all, share, a.*of);
  };
  result.z = place(&Corner<true>::z);
  result.s = place(&Corner<true>::s);
  const MF known = hn::Ge(sum, hn::Set(d, kEdgeOn));
  if (HWY_UNLIKELY(!hn::AllTrue(d, known))) {
    StepResult in_plane;
    MeasureEdgeOn(a, b, c, in_plane);
    result.z = hn::IfThenElse(known, result.z, in_plane.z);
    result.s = hn::IfThenElse(known, result.s, in_plane.s);
  }
}

#else

constexpr bool kByWeights = false;

HWY_INLINE void Measure(const Corner<true>& a, const Corner<true>& b, const Corner<true>& c,
                        const Across&, StepResult& result) {
  MeasureBetweenEdges(a, b, c, result);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
