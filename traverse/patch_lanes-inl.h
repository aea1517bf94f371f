// Where rays cross bilinear patches, a ray a lane. Compiled once for each instruction set: to be
// included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_PATCH_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_PATCH_LANES_INL_H_
#undef PLUME_TRAVERSE_PATCH_LANES_INL_H_
#else
#define PLUME_TRAVERSE_PATCH_LANES_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "plume/traverse/packet_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

HWY_INLINE VF Xor3(VF a, VF b, VF c) { return hn::Xor(a, hn::Xor(b, c)); }
HWY_INLINE VF Or3(VF a, VF b, VF c) { return hn::Or(a, hn::Or(b, c)); }

// Quadrilaterals in the lanes' sheared frames. Where nothing is measured, z and s are left alone.
template <bool kMeasure>
struct QuadLanes {
  VF x[4], y[4], z[4], s[4];
};

// measure_patch() in single precision, for a loop that winds once about the ray; the sign of
// `winding` says in which direction. The line that joins corner 0 and 3 at v to 1 and 2 at v passes
// through the ray where
//     front (1 - v)^2 + middle v (1 - v) + back v^2 = 0,
// whose coefficients are cross products of the corners, free of cancellation; a loop of positive
// winding is crossed where that falls. Of v / (1 - v) = root, the form that does not cancel is
// taken. Roots: Reshetov, "Cool Patches" (Ray Tracing Gems, 2019).
//
// Returned are the lanes where that is not so: beside the patch, by rounding, or no number at all,
// where the face is seen edge-on. measure_patch() knows what to do then.
HWY_INLINE MF MeasurePatch(const QuadLanes<true>& p, VF winding, VF& z, VF& s) {
  const DF d;
  const VF zero = hn::Zero(d);
  auto cross = [&](std::size_t a, std::size_t b) {
    return DifferenceOfProducts(p.x[a], p.y[b], p.x[b], p.y[a]);
  };
  // Only ratios of these count. Where the face is about the ray coordinates are below 4, so squares
  // do not overflow; those of cells that are wider than 2^-50 of the mesh do not underflow.
  const VF scale = hn::CopySignToAbs(hn::Set(d, 0x1p56f), winding);
  const VF front = hn::Mul(cross(0, 1), scale);
  const VF back = hn::Mul(cross(2, 3), scale);  // minus the coefficient: >= 0 in a convex face
  const VF middle = hn::Mul(hn::Add(cross(0, 2), cross(3, 1)), scale);
  const VF root = hn::Sqrt(
      hn::Max(zero, hn::MulAdd(middle, middle, hn::Mul(hn::Set(d, 4.0f), hn::Mul(front, back)))));
  const VF sum = hn::Add(hn::Abs(middle), root);
  const VF of_v = Choose(middle, hn::Add(front, front), sum);
  const VF of_rest = Choose(middle, sum, hn::Add(back, back));
  // u is the same whatever (1 - v) and v are multiplied with: it need not wait for v.
  auto across = [&](const VF(&values)[4], VF& from, VF& way) {
    from = hn::MulAdd(of_v, values[3], hn::Mul(of_rest, values[0]));
    way = hn::Sub(from, hn::MulAdd(of_v, values[2], hn::Mul(of_rest, values[1])));
  };
  VF from_x, way_x, from_y, way_y;
  across(p.x, from_x, way_x);
  across(p.y, from_y, way_y);
  const MF by_x = hn::Gt(hn::Abs(way_x), hn::Abs(way_y));
  const VF u = hn::Div(hn::IfThenElse(by_x, from_x, from_y), hn::IfThenElse(by_x, way_x, way_y));
  const VF v = hn::Div(of_v, hn::Add(of_v, of_rest));
  auto at = [&](const VF(&values)[4]) {
    const VF from = hn::MulAdd(v, hn::Sub(values[3], values[0]), values[0]);
    const VF to = hn::MulAdd(v, hn::Sub(values[2], values[1]), values[1]);
    return hn::MulAdd(u, hn::Sub(to, from), from);
  };
  z = at(p.z);
  s = at(p.s);
  const VF half = hn::Set(d, 0.5f);
  const MF inside = hn::And(hn::Le(hn::Abs(hn::Sub(v, half)), half),  // false for no number
                            hn::Le(hn::Abs(hn::Sub(u, half)), half));
  return hn::Not(inside);
}

// Whether a face winds twice: its corners are above and below y = 0 in turn, and its edges cross on
// the right and on the left in turn. Of edges one after the other: whether they cross (the fourth
// does where the others do), and on the right.
HWY_INLINE VF WindsTwice(VF crosses0, VF crosses1, VF crosses2, VF right0, VF right1, VF right2,
                         VF right3) {
  return hn::And(
      hn::And(crosses0, hn::And(crosses1, crosses2)),
      hn::And(hn::Xor(right0, right1), hn::And(hn::Xor(right1, right2), hn::Xor(right2, right3))));
}

// Whether faces of winding 0 may be crossed, in and out again: is_grazed() of quad_crossings.h with
// room for what single precision does, so that no crossing is missed.
class GrazeTest {
 public:
  // Bounds of the absolute coordinates of all corners.
  GrazeTest(VF x, VF y) {
    // Products of two coordinates are below x * y, their rounding below 2^-24 of that; a sum of two
    // differences of them is off by 12 such at the most.
    error_ = hn::Mul(hn::Mul(x, y), hn::Set(DF(), 0x1p-20f));
  }

  // Cross product whose sign is right, or it is 0.
  static HWY_INLINE VF Product(VF ax, VF ay, VF bx, VF by) {
    return hn::Sub(hn::MulAdd(ax, by, hn::Zero(DF())), hn::Mul(bx, ay));
  }

  // Negative where signs alone say that the face a, b, c, d is not grazed: v0 and v2 are the
  // products of a and b, d and c, u0 and u2 those of a and d, b and c. It takes opposite edges on
  // the same side, and a middle coefficient, ac - bd or ac + bd, of the other sign than v0 or u0.
  // Needs no bounds; a product of nearly zero settles nothing. In a convex face nothing else is
  // left.
  static HWY_INLINE VF PassedBySigns(VF v0, VF v2, VF u0, VF u2, VF ac, VF bd) {
    const VF tiny = hn::Set(DF(), 1e-37f);  // above what underflows
    const VF edges = hn::Or(hn::MulAdd(v0, v2, tiny), hn::MulAdd(u0, u2, tiny));
    const VF v_middle = hn::And(hn::NegMulAdd(v0, ac, tiny), hn::MulAdd(v0, bd, tiny));
    const VF u_middle = hn::And(hn::NegMulAdd(u0, ac, tiny), hn::NegMulAdd(u0, bd, tiny));
    return hn::Or(edges, hn::Or(v_middle, u_middle));
  }

  // The same by sizes as well.
  HWY_INLINE VF PassedBy(VF v0, VF v2, VF u0, VF u2, VF ac, VF bd) const {
    const DF d;
    const VF tiny = hn::Set(d, 1e-37f);  // above what underflows
    const VF four = hn::Set(d, 4);
    const VF v1 = hn::Sub(ac, bd), u1 = hn::Add(ac, bd);
    // The signs of edges' products are right where they are not 0, and those of their bits then.
    const VF ends = hn::Or(hn::MulAdd(v0, v2, tiny), hn::MulAdd(u0, u2, tiny));
    auto opposite = [&](VF edge, VF middle) {
      return hn::NegMulAdd(edge, middle, hn::MulAdd(hn::Abs(edge), error_, tiny));
    };
    const VF middles = hn::Or(opposite(v0, v1), opposite(u0, u1));
    const VF sizes = hn::MulAdd(four, hn::Add(hn::Abs(v0), hn::Abs(v2)),
                                hn::MulAdd(hn::Set(d, 2), hn::Abs(v1), error_));
    const VF discriminant =
        hn::NegMulAdd(hn::Mul(four, v0), v2, hn::MulAdd(v1, v1, hn::MulAdd(sizes, error_, tiny)));
    return hn::Or(hn::Or(ends, discriminant), middles);
  }

 private:
  VF error_;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
