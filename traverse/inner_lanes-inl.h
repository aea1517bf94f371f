// The scalar inside of hexahedral cells, a segment a lane: what orders above 1 need. Compiled once
// for each instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_INNER_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_INNER_LANES_INL_H_
#undef PLUME_TRAVERSE_INNER_LANES_INL_H_
#else
#define PLUME_TRAVERSE_INNER_LANES_INL_H_
#endif
// clang-format on

#include <array>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "plume/mesh/walkable_cells.h"
#include "plume/mesh/walkable_grid.h"
#include "plume/traverse/hexahedron_corners-inl.h"
#include "plume/traverse/inner_scalar.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/packet_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// invert() (isoparametric.h) in single precision, a lane each, for the places inside of a segment
// that orders above 1 look at. All is taken relative to the cell's first corner, where
// the corners' differences lose nothing: what is found is the scalar of a place that is no farther
// than 2^-21 of the mesh's half size from the one that was meant (as far as a ray's z is rounded,
// and less than that across it), up to 1e-6 of the differences of the cell's values.
//
// Newton's method, whole steps. With w / 2 the constant of its quadratic convergence, estimated as
// step / (step before)^2, what is left after a step is step (step / step before)^2: accepted below
// 1e-6. Lanes that do not come to that in kSteps steps, whose place is farther than
// kFarthestOutside from the cell, or that have no corners, ask the scalar code.
template <class Mesh>
class InnerLanes {
 public:
  InnerLanes(const Mesh& mesh, int axis) : mesh_(mesh), corners_(mesh), axis_(axis) {}

  // Where a lane's ray comes in.
  void begin(std::size_t packet, std::size_t lane, const PacketStart& start) {
    Lanes& mine = lanes_[packet];
    mine.slope_x[lane] = start.line.slope_x;
    mine.slope_y[lane] = start.line.slope_y;
    mine.offset_x[lane] = start.line.offset_x;
    mine.offset_y[lane] = start.line.offset_y;
    mine.z_out[lane] = start.z;
  }
  // Where the lanes' segments end; they begin where those before ended.
  HWY_INLINE void ends_at(std::size_t packet, VF z) {
    const DF d;
    Lanes& mine = lanes_[packet];
    hn::Store(hn::Load(d, mine.z_out), d, mine.z_in);
    hn::Store(z, d, mine.z_out);
  }

  // The local z at a share of the lanes' ways through their cells.
  HWY_INLINE VF Z(std::size_t packet, VF share) const {
    const DF d;
    const VF z_in = hn::Load(d, lanes_[packet].z_in);
    return hn::MulAdd(share, hn::Sub(hn::Load(d, lanes_[packet].z_out), z_in), z_in);
  }

  // The scalar half way, or at a third and at two thirds of it. Returns the lanes of which it is
  // known; the others' are linear.
  template <std::size_t kCount>
  HWY_INLINE MF At(std::size_t packet, MF active, VU cells, VF (&inner)[kCount]) const {
    const DF d;
    const Lanes& mine = lanes_[packet];
    const Along along(*this, mine, cells);
    active = hn::And(active, along.Advances());
    MF asks = hn::And(active, along.Asks());
    const VF half = hn::Set(d, 0.5f);
    Parameters at{half, half, half};
    for (std::size_t i = 0; i < kCount; ++i) {
      const VF share = hn::Set(d, static_cast<float>(i + 1) / static_cast<float>(kCount + 1));
      const MF found = along.Find(hn::AndNot(asks, active), share, at);
      asks = hn::Or(asks, hn::AndNot(found, active));
      inner[i] = along.Scalar(at);
    }
    const unsigned asking = BitsOf(asks);
    if (HWY_UNLIKELY(asking != 0)) return Ask<kCount>(mine, asking, active, cells, inner);
    return active;
  }

  // Parts of the lanes' segments along which the cubic through four equidistant values is within
  // `tolerance` of the scalar, as far as its slopes at the two inner ones tell. Calls
  //     visit(lanes, curved, from, to, s_from, s_to, inner)
  // for a part of each of `lanes`, from and to a share of the way, and in turn of each lane's; the
  // parts of lanes that are not `curved` are linear. Parts join bit for bit, but for rounding of
  // the shares. Lanes that visit() returns are done.
  //
  // Where the inverse Jacobian is known, so is the scalar's slope along the ray, for a third of
  // what a further place would cost. What the cubic's slopes at a third and at two thirds differ by
  // from the scalar's, e and f, says how far the cubic is off in between: by |e| / 6 = |f| / 6
  // where the scalar is of degree 4. (|e| + |f|) / 3 bounds also what cells that are nearly
  // collapsed make of a scalar, square roots and hyperbolas with an end or a bend close to the
  // segment (within 1.9 times; three values more, as the scalar code looks at, within 1.8).
  template <class Visit>
  HWY_INLINE void ForEachClosePart(std::size_t packet, MF active, VU cells, VF s_in, VF s_out,
                                   float tolerance, const Visit& visit) const {
    const DF d;
    const Lanes& mine = lanes_[packet];
    const Along along(*this, mine, cells);
    const VF one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f), third = hn::Set(d, 1.0f / 3);
    const MF inside = along.Advances();
    MF asks = hn::And(hn::And(active, inside), along.Asks());
    VF from = hn::Zero(d), size = one, s_from = s_in;
    Parameters at{half, half, half};
    for (MF on = hn::AndNot(asks, active); !hn::AllFalse(d, on);) {
      const MF last = hn::Ge(size, hn::Sub(one, from));
      size = hn::IfThenElse(last, hn::Sub(one, from), size);
      const VF to = hn::IfThenElse(last, one, hn::Add(from, size));
      MF found = hn::And(on, inside);
      VF inner[2], slope[2];
      for (std::size_t i = 0; i < 2; ++i) {
        const VF share = i == 0 ? third : hn::Set(d, 2.0f / 3);
        found = along.Find(found, hn::MulAdd(share, size, from), at);
        inner[i] = along.Scalar(at);
        slope[i] = hn::Mul(size, along.Slope(at, hn::Mul(third, size)));
      }
      VF s_to = s_out;
      const MF between = hn::AndNot(last, found);
      if (HWY_UNLIKELY(!hn::AllFalse(d, between))) {
        const MF known = along.Find(between, to, at);
        found = hn::AndNot(hn::AndNot(known, between), found);
        s_to = hn::IfThenElse(last, s_out, along.Scalar(at));
      }
      const MF lost = hn::AndNot(found, hn::And(on, inside));
      asks = hn::Or(asks, lost);

      const VF error = OffBy(s_from, inner, s_to, slope);
      const VF enough = hn::Add(hn::Set(d, tolerance), along.Rounding(s_from, inner, slope, size));
      const MF too_long = hn::And(hn::Gt(error, enough), hn::Gt(size, hn::Set(d, kShortest)));
      const MF takes = hn::AndNot(lost, hn::AndNot(hn::And(found, too_long), on));
      MF done = hn::And(takes, last);
      if (!hn::AllFalse(d, takes))
        done = hn::Or(done, hn::And(takes, visit(takes, hn::And(found, takes), from, to, s_from,
                                                 s_to, inner)));
      on = hn::AndNot(hn::Or(done, lost), on);
      // The error goes with the fourth power of the size.
      const VF could = hn::Mul(hn::Set(d, 0.9f), hn::Sqrt(hn::Sqrt(hn::Div(enough, error))));
      const VF most = hn::IfThenElse(takes, hn::Set(d, 4.0f), hn::Set(d, 0.7f));
      // The most, also where it is no number.
      size = hn::Mul(size,
                     hn::IfThenElse(hn::Lt(could, most), hn::Max(could, hn::Set(d, 0.125f)), most));
      from = hn::IfThenElse(takes, to, from);
      s_from = hn::IfThenElse(takes, s_to, s_from);
    }
    const unsigned asking = BitsOf(asks);
    if (HWY_UNLIKELY(asking != 0))
      AskParts(mine, asking, cells, from, s_from, s_out, tolerance, visit);
  }

 private:
  static constexpr int kSteps = 8;
  static constexpr float kShortest = 0x1p-12f;  // of a segment

  struct Lanes {
    HWY_ALIGN float slope_x[kMaxLanes] = {};
    HWY_ALIGN float slope_y[kMaxLanes] = {};
    HWY_ALIGN float offset_x[kMaxLanes] = {};
    HWY_ALIGN float offset_y[kMaxLanes] = {};
    HWY_ALIGN float z_in[kMaxLanes] = {};
    HWY_ALIGN float z_out[kMaxLanes] = {};
  };

  static HWY_INLINE ShearedLanes Permuted(const FourFloats& p, int axis) {
    return {axis == 0   ? p.b
            : axis == 1 ? p.c
                        : p.a,
            axis == 0   ? p.c
            : axis == 1 ? p.a
                        : p.b,
            axis == 0   ? p.a
            : axis == 1 ? p.b
                        : p.c,
            p.d};
  }

  // Of cells.
  struct Parameters {
    VF r, s, t;
  };

  // A trilinear map from the first corner on, in the lanes' sheared frames.
  class Map {
   public:
    HWY_INLINE Map(const FourFloats (&corner)[8], int axis, VF slope_x, VF slope_y) {
      ShearedLanes e[8];
      for (std::size_t c = 1; c < 8; ++c) {
        const ShearedLanes edge =
            Permuted({hn::Sub(corner[c].a, corner[0].a), hn::Sub(corner[c].b, corner[0].b),
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

    HWY_INLINE VF Scalar(VF r, VF s, VF t) const { return At(s_, r, s, t); }

    // The parameters' derivatives by z along a ray, on which x and y stay what they are, and what
    // the scalar's are then.
    HWY_INLINE VF Slopes(const Parameters& at, Parameters& slopes) const {
      VF dx[3], dy[3], dz[3], ds[3];
      Derivatives(x_, at.r, at.s, at.t, dx);
      Derivatives(y_, at.r, at.s, at.t, dy);
      Derivatives(z_, at.r, at.s, at.t, dz);
      Derivatives(s_, at.r, at.s, at.t, ds);
      auto minor = [](VF a, VF b, VF c, VF e) { return hn::MulSub(a, b, hn::Mul(c, e)); };
      const Parameters along{minor(dx[1], dy[2], dx[2], dy[1]), minor(dx[2], dy[0], dx[0], dy[2]),
                             minor(dx[0], dy[1], dx[1], dy[0])};
      auto dot = [](const VF(&a)[3], const Parameters& b) {
        return hn::MulAdd(a[0], b.r, hn::MulAdd(a[1], b.s, hn::Mul(a[2], b.t)));
      };
      const VF inverse = hn::Div(hn::Set(DF(), 1.0f), dot(dz, along));
      slopes = {hn::Mul(along.r, inverse), hn::Mul(along.s, inverse), hn::Mul(along.t, inverse)};
      return dot(ds, slopes);
    }
    // The lanes among `active` whose parameters came to lead to that place.
    HWY_INLINE MF Invert(MF active, VF x, VF y, VF z, VF& r, VF& s, VF& t) const {
      const DF d;
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
        found =
            hn::Or(found, hn::And(moves, hn::And(hn::Lt(length, before), hn::Le(left, enough))));
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

  // The lanes' cells along their rays: a place is a share of the way from where a ray comes in to
  // where it leaves.
  class Along {
   public:
    HWY_INLINE Along(const InnerLanes& all, const Lanes& mine, VU cells)
        : Along(all, mine, Load(all, cells)) {}

    // Lanes that get on at all, and those whose cells only the scalar code knows.
    HWY_INLINE MF Advances() const { return hn::Ne(way_, hn::Zero(DF())); }
    HWY_INLINE MF Asks() const { return asks_; }
    // The lanes among `active` whose parameters came to lead to that place.
    HWY_INLINE MF Find(MF active, VF share, Parameters& at) const {
      return map_.Invert(active, x_, y_, hn::MulAdd(share, way_, from_), at.r, at.s, at.t);
    }
    HWY_INLINE VF Scalar(const Parameters& at) const {
      return hn::Add(map_.Scalar(at.r, at.s, at.t), first_);
    }
    // By the share. The parameters go on to where they would be after another `share`, if they went
    // on as they do here, but not far from the cell.
    HWY_INLINE VF Slope(Parameters& at, VF share) const {
      const DF d;
      Parameters slopes;
      const VF slope = map_.Slopes(at, slopes);
      const VF step = hn::Mul(share, way_);
      auto go_on = [&](VF& parameter, VF by) {
        const VF farthest = hn::Set(d, static_cast<float>(kFarthestOutside));
        parameter = hn::Min(hn::Max(hn::MulAdd(step, by, parameter), hn::Neg(farthest)),
                            hn::Add(farthest, hn::Set(d, 1.0f)));
      };
      go_on(at.r, slopes.r);
      go_on(at.s, slopes.s);
      go_on(at.t, slopes.t);
      return hn::Mul(way_, slope);
    }
    // What rounding of four values, each of a place that is 2^-21 off, makes of OffBy(): a slope in
    // between changes by up to six times as much as these.
    HWY_INLINE VF Rounding(VF s_from, const VF (&inner)[2], const VF (&slope)[2], VF size) const {
      const DF d;
      const VF steepest = hn::Max(hn::Abs(slope[0]), hn::Abs(slope[1]));
      const VF of_places = hn::Div(steepest, hn::Abs(hn::Mul(way_, size)));
      const VF largest = hn::Max(hn::Abs(s_from), hn::Max(hn::Abs(inner[0]), hn::Abs(inner[1])));
      return hn::MulAdd(of_places, hn::Set(d, 4 * 0x1p-21f),
                        hn::Mul(largest, hn::Set(d, 4 * 0x1p-23f)));
    }

   private:
    struct Corners {
      FourFloats corner[8];
      MF none;
    };
    static HWY_INLINE Corners Load(const InnerLanes& all, VU cells) {
      Corners loaded;
      loaded.none = all.corners_.Load(cells, loaded.corner);
      return loaded;
    }
    HWY_INLINE Along(const InnerLanes& all, const Lanes& mine, const Corners& loaded)
        : map_(loaded.corner, all.axis_, hn::Load(DF(), mine.slope_x),
               hn::Load(DF(), mine.slope_y)),
          asks_(loaded.none) {
      const DF d;
      // The ray from the first corner, at that corner's z.
      const ShearedLanes first = Permuted(loaded.corner[0], all.axis_);
      const VF z_in = hn::Load(d, mine.z_in);
      x_ = hn::NegMulAdd(hn::Load(d, mine.slope_x), first.z,
                         hn::Sub(first.x, hn::Load(d, mine.offset_x)));
      y_ = hn::NegMulAdd(hn::Load(d, mine.slope_y), first.z,
                         hn::Sub(first.y, hn::Load(d, mine.offset_y)));
      x_ = hn::Neg(x_);
      y_ = hn::Neg(y_);
      way_ = hn::Sub(hn::Load(d, mine.z_out), z_in);
      from_ = hn::Sub(z_in, first.z);
      first_ = first.s;
    }

    const Map map_;
    MF asks_;
    VF x_, y_, from_, way_;
    VF first_;  // the first corner's scalar
  };

  // How far the cubic through four values is from a scalar of these slopes at the inner two.
  static HWY_INLINE VF OffBy(VF s_from, const VF (&inner)[2], VF s_to, const VF (&slope)[2]) {
    const DF d;
    auto times = [&](float factor, VF value) { return hn::Mul(hn::Set(d, factor), value); };
    const VF first = hn::Sub(inner[0], s_from), second = hn::Sub(inner[1], s_from);
    const VF all = hn::Sub(s_to, s_from);
    // Of equidistant values f0 to f3: (-2 f0 - 3 f1 + 6 f2 - f3) / 2 and (f0 - 6 f1 + 3 f2 + 2 f3)
    // / 2.
    const VF at_first =
        hn::Sub(times(3, second), hn::MulAdd(hn::Set(d, 1.5f), first, times(0.5f, all)));
    const VF at_second = hn::Sub(hn::MulAdd(hn::Set(d, 1.5f), second, all), times(3, first));
    return times(1.0f / 3, hn::Add(hn::Abs(hn::Sub(at_first, slope[0])),
                                   hn::Abs(hn::Sub(at_second, slope[1]))));
  }

  // Some lanes' segments from where they have come to by the scalar code, in double.
  template <class Visit>
  HWY_NOINLINE void AskParts(const Lanes& mine, unsigned asking, VU cells, VF from, VF s_from,
                             VF s_out, float tolerance, const Visit& visit) const {
    const DF d;
    HWY_ALIGN std::uint32_t cell[kMaxLanes];
    HWY_ALIGN float first[kMaxLanes], s_first[kMaxLanes], s_last[kMaxLanes];
    hn::Store(cells, DU(), cell);
    hn::Store(from, d, first);
    hn::Store(s_from, d, s_first);
    hn::Store(s_out, d, s_last);
    for (; asking != 0; asking &= asking - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(asking);
      HWY_ALIGN float is_lane[kMaxLanes] = {};
      is_lane[lane] = 1;
      const MF on = hn::Gt(hn::Load(d, is_lane), hn::Zero(d));
      const double begin = first[lane];
      // Its places are shares of what is left.
      const Segment whole{0, 1, s_first[lane], s_last[lane], cell[lane]};
      for_each_close_part(
          mesh_, [&](double share) { return PlaceOf(mine, lane, begin + share * (1 - begin)); },
          tolerance, whole,
          [&](const Segment& part) {
            auto set = [&](double value) { return hn::Set(d, static_cast<float>(value)); };
            const VF inner[2] = {set(part.inner[0]), set(part.inner[1])};
            const MF curved = part.order == ScalarOrder::linear ? hn::AndNot(on, on) : on;
            const MF done = visit(on, curved, set(begin + part.t_in * (1 - begin)),
                                  set(begin + part.t_out * (1 - begin)), set(part.s_in),
                                  set(part.s_out), inner);
            return hn::AllFalse(d, hn::And(on, done));
          });
    }
  }

  // In the mesh's frame, at a share of a lane's way through its cell.
  HWY_INLINE Place PlaceOf(const Lanes& mine, std::size_t lane, double share) const {
    const double z_in = mine.z_in[lane], z_out = mine.z_out[lane];
    const double z = z_in + share * (z_out - z_in);
    const auto axis = static_cast<std::size_t>(axis_);
    Place place;
    place[(axis + 1) % 3] = mine.offset_x[lane] + static_cast<double>(mine.slope_x[lane]) * z;
    place[(axis + 2) % 3] = mine.offset_y[lane] + static_cast<double>(mine.slope_y[lane]) * z;
    place[axis] = z;
    return place;
  }

  // Some lanes by the scalar code, in double. Returns the lanes of which the scalar is known.
  template <std::size_t kCount>
  HWY_NOINLINE MF Ask(const Lanes& mine, unsigned asking, MF active, VU cells,
                      VF (&inner)[kCount]) const {
    const DF d;
    HWY_ALIGN std::uint32_t cell[kMaxLanes];
    HWY_ALIGN float values[kCount][kMaxLanes], known[kMaxLanes];
    hn::Store(cells, DU(), cell);
    for (std::size_t i = 0; i < kCount; ++i) hn::Store(inner[i], d, values[i]);
    hn::Store(hn::IfThenElseZero(active, hn::Set(d, 1)), d, known);
    for (; asking != 0; asking &= asking - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(asking);
      std::array<Place, kCount> places;
      for (std::size_t i = 0; i < kCount; ++i) {
        const double share = static_cast<double>(i + 1) / static_cast<double>(kCount + 1);
        places[i] = PlaceOf(mine, lane, share);
      }
      std::array<float, kCount> found{};
      known[lane] = scalars_inside(mesh_, cell[lane], places, found.data()) ? 1.0f : 0.0f;
      for (std::size_t i = 0; i < kCount; ++i) values[i][lane] = found[i];
    }
    for (std::size_t i = 0; i < kCount; ++i) inner[i] = hn::Load(d, values[i]);
    return hn::Gt(hn::Load(d, known), hn::Zero(d));
  }

  const Mesh& mesh_;
  const CornersOf<Mesh> corners_;
  const int axis_;
  Lanes lanes_[kMaxPackets];
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
