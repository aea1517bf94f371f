// Trilinear maps of hexahedral cells and their inverse, a cell a lane. Compiled once for each
// instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_TRILINEAR_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_TRILINEAR_LANES_INL_H_
#undef PLUME_TRAVERSE_TRILINEAR_LANES_INL_H_
#else
#define PLUME_TRAVERSE_TRILINEAR_LANES_INL_H_
#endif
// clang-format on

#include <cstddef>

#include "hwy/highway.h"
#include "plume/traverse/isoparametric.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/packet_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// Of cells.
struct CellParameters {
  VF r, s, t;
};

// A trilinear map from the first corner on, where the corners' differences lose nothing, in the
// lanes' sheared frames.
class TrilinearLanes {
 public:
  HWY_INLINE TrilinearLanes(const FourFloats (&corner)[8], int axis, VF slope_x, VF slope_y) {
    ShearedLanes e[8];
    for (std::size_t c = 1; c < 8; ++c) {
      const ShearedLanes edge =
          Turned({hn::Sub(corner[c].a, corner[0].a), hn::Sub(corner[c].b, corner[0].b),
                  hn::Sub(corner[c].c, corner[0].c), hn::Sub(corner[c].d, corner[0].d)},
                 axis);
      e[c] = {hn::NegMulAdd(slope_x, edge.z, edge.x), hn::NegMulAdd(slope_y, edge.z, edge.y),
              edge.z, edge.s};
    }
    auto terms = [&](VF ShearedLanes::*of, VF(&m)[7]) {
      m[0] = e[1].*of;
      m[1] = e[2].*of;
      m[2] = e[4].*of;
      m[3] = hn::Sub(hn::Sub(e[3].*of, e[2].*of), m[0]);  // rs
      m[4] = hn::Sub(hn::Sub(e[6].*of, e[4].*of), m[1]);  // st
      m[5] = hn::Sub(hn::Sub(e[5].*of, e[1].*of), m[2]);  // tr
      m[6] = hn::Sub(hn::Sub(hn::Sub(e[7].*of, e[6].*of), hn::Sub(e[5].*of, e[4].*of)), m[3]);
    };
    terms(&ShearedLanes::x, x_);
    terms(&ShearedLanes::y, y_);
    terms(&ShearedLanes::z, z_);
    terms(&ShearedLanes::s, s_);
  }

  HWY_INLINE VF Scalar(const CellParameters& at) const { return At(s_, at.r, at.s, at.t); }

  // The parameters' derivatives by z along a ray, on which x and y stay what they are, and what
  // the scalar's are then.
  HWY_INLINE VF Slopes(const CellParameters& at, CellParameters& slopes) const {
    VF dx[3], dy[3], dz[3], ds[3];
    Derivatives(x_, at.r, at.s, at.t, dx);
    Derivatives(y_, at.r, at.s, at.t, dy);
    Derivatives(z_, at.r, at.s, at.t, dz);
    Derivatives(s_, at.r, at.s, at.t, ds);
    auto minor = [](VF a, VF b, VF c, VF e) { return hn::MulSub(a, b, hn::Mul(c, e)); };
    const CellParameters along{minor(dx[1], dy[2], dx[2], dy[1]), minor(dx[2], dy[0], dx[0], dy[2]),
                               minor(dx[0], dy[1], dx[1], dy[0])};
    auto dot = [](const VF(&a)[3], const CellParameters& b) {
      return hn::MulAdd(a[0], b.r, hn::MulAdd(a[1], b.s, hn::Mul(a[2], b.t)));
    };
    const VF inverse = hn::Div(hn::Set(DF(), 1.0f), dot(dz, along));
    slopes = {hn::Mul(along.r, inverse), hn::Mul(along.s, inverse), hn::Mul(along.t, inverse)};
    return dot(ds, slopes);
  }

  // The lanes among `active` whose parameters came to lead to that place, by Newton's method, whole
  // steps. With w / 2 the constant of its quadratic convergence, estimated as step / (step
  // before)^2, what is left after a step is step (step / step before)^2: accepted below 1e-6
  // (kParameterTolerance). Not sure are lanes that do not come to that in kSteps steps, or whose
  // place is farther than kFarthestOutside from the cell.
  HWY_INLINE MF Invert(MF active, VF x, VF y, VF z, CellParameters& at) const {
    const DF d;
    VF &r = at.r, &s = at.s, &t = at.t;
    const VF enough = hn::Set(d, static_cast<float>(kParameterTolerance));
    MF found = hn::MaskFromVec(hn::Zero(d));
    // Of no first step its convergence is known.
    VF before = hn::Set(d, 1e-3f);
    for (int step = 0; step < kSteps; ++step) {
      VF dx[3], dy[3], dz[3];
      Derivatives(x_, r, s, t, dx);
      Derivatives(y_, r, s, t, dy);
      Derivatives(z_, r, s, t, dz);
      const VF left_x = hn::Sub(x, At(x_, r, s, t)), left_y = hn::Sub(y, At(y_, r, s, t));
      const VF left_z = hn::Sub(z, At(z_, r, s, t));
      // Cramer's rule.
      auto minor = [](VF a, VF b, VF c, VF e) { return hn::MulSub(a, b, hn::Mul(c, e)); };
      const VF m0 = minor(dy[1], dz[2], dy[2], dz[1]), m1 = minor(dy[2], dz[0], dy[0], dz[2]);
      const VF m2 = minor(dy[0], dz[1], dy[1], dz[0]);
      const VF determinant = hn::MulAdd(dx[0], m0, hn::MulAdd(dx[1], m1, hn::Mul(dx[2], m2)));
      const VF inverse = hn::Div(hn::Set(d, 1.0f), determinant);
      const VF n0 = minor(dx[2], dz[1], dx[1], dz[2]), n1 = minor(dx[0], dz[2], dx[2], dz[0]);
      const VF n2 = minor(dx[1], dz[0], dx[0], dz[1]);
      const VF o0 = minor(dx[1], dy[2], dx[2], dy[1]), o1 = minor(dx[2], dy[0], dx[0], dy[2]);
      const VF o2 = minor(dx[0], dy[1], dx[1], dy[0]);
      auto solve = [&](VF a, VF b, VF c) {
        return hn::Mul(inverse, hn::MulAdd(a, left_x, hn::MulAdd(b, left_y, hn::Mul(c, left_z))));
      };
      const VF dr = solve(m0, n0, o0), ds = solve(m1, n1, o1), dt = solve(m2, n2, o2);
      // Lanes that are done stay where they are.
      const MF moves = hn::AndNot(found, active);
      r = hn::Add(r, hn::IfThenElseZero(moves, dr));
      s = hn::Add(s, hn::IfThenElseZero(moves, ds));
      t = hn::Add(t, hn::IfThenElseZero(moves, dt));
      const VF length = hn::Max(hn::Abs(dr), hn::Max(hn::Abs(ds), hn::Abs(dt)));
      const VF ratio = hn::Div(length, before);
      const VF left = hn::Mul(length, hn::Mul(ratio, ratio));
      found = hn::Or(found, hn::And(moves, hn::And(hn::Lt(length, before), hn::Le(left, enough))));
      before = length;
      if (hn::AllTrue(d, hn::Or(found, hn::Not(active)))) break;
    }
    // Also false for what is no number.
    const VF low = hn::Set(d, static_cast<float>(-kFarthestOutside));
    const VF high = hn::Set(d, static_cast<float>(1 + kFarthestOutside));
    const MF inside =
        hn::And(hn::Ge(hn::Min(r, hn::Min(s, t)), low), hn::Le(hn::Max(r, hn::Max(s, t)), high));
    return hn::And(found, inside);
  }

 private:
  static constexpr int kSteps = 8;

  static HWY_INLINE VF At(const VF (&m)[7], VF r, VF s, VF t) {
    const VF along_t = hn::MulAdd(t, hn::MulAdd(r, m[5], m[2]), hn::Mul(r, m[0]));
    return hn::MulAdd(s, hn::MulAdd(t, hn::MulAdd(r, m[6], m[4]), hn::MulAdd(r, m[3], m[1])),
                      along_t);
  }
  static HWY_INLINE void Derivatives(const VF (&m)[7], VF r, VF s, VF t, VF (&d)[3]) {
    d[0] = hn::MulAdd(s, hn::MulAdd(t, m[6], m[3]), hn::MulAdd(t, m[5], m[0]));
    d[1] = hn::MulAdd(t, hn::MulAdd(r, m[6], m[4]), hn::MulAdd(r, m[3], m[1]));
    d[2] = hn::MulAdd(r, hn::MulAdd(s, m[6], m[5]), hn::MulAdd(s, m[4], m[2]));
  }

  VF x_[7], y_[7], z_[7], s_[7];
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
