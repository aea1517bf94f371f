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
#include "plume/traverse/trilinear_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// invert() (isoparametric.h) in single precision, a lane each, for the places inside of a segment
// that orders above 1 look at: what is found is the scalar of a place that is no farther than 2^-21
// of the mesh's half size from the one that was meant (as far as a ray's z is rounded, and less
// than that across it), up to 1e-6 of the differences of the cell's values. Lanes whose cells have
// no corners, or of whose parameters TrilinearLanes is not sure, ask the scalar code.
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

  HWY_INLINE VF EndsAt(std::size_t packet) const {
    return hn::Load(DF(), lanes_[packet].z_out);
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
    CellParameters at{half, half, half};
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
    CellParameters at{half, half, half};
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
  static constexpr float kShortest = 0x1p-12f;  // of a segment

  struct Lanes {
    HWY_ALIGN float slope_x[kMaxLanes] = {};
    HWY_ALIGN float slope_y[kMaxLanes] = {};
    HWY_ALIGN float offset_x[kMaxLanes] = {};
    HWY_ALIGN float offset_y[kMaxLanes] = {};
    HWY_ALIGN float z_in[kMaxLanes] = {};
    HWY_ALIGN float z_out[kMaxLanes] = {};
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
    HWY_INLINE MF Find(MF active, VF share, CellParameters& at) const {
      return map_.Invert(active, x_, y_, hn::MulAdd(share, way_, from_), at);
    }
    HWY_INLINE VF Scalar(const CellParameters& at) const {
      return hn::Add(map_.Scalar(at), first_);
    }
    // By the share. The parameters go on to where they would be after another `share`, if they went
    // on as they do here, but not far from the cell.
    HWY_INLINE VF Slope(CellParameters& at, VF share) const {
      const DF d;
      CellParameters slopes;
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
      const ShearedLanes first = Turned(loaded.corner[0], all.axis_);
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

    const TrilinearLanes map_;
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
