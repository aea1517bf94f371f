// Cells of up to eight corners against a vector of rays. Compiled once for each instruction set: to
// be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_HEXAHEDRON_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_HEXAHEDRON_LANES_INL_H_
#undef PLUME_TRAVERSE_HEXAHEDRON_LANES_INL_H_
#else
#define PLUME_TRAVERSE_HEXAHEDRON_LANES_INL_H_
#endif
// clang-format on

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "plume/mesh/corner_cells.h"
#include "plume/traverse/sheared_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Which faces of a cell, the corners of which are laid out as CornerCell's, rays may cross: all
// that they do cross, and hardly any other. A face is crossed where its loop winds about the ray,
// which parity says but for windings of 2; and where it is twisted and grazed.
class HexahedronLanes {
 public:
  using V = ShearedLanes::V;
  using M = ShearedLanes::M;

  template <std::size_t kPlaces>
  HWY_INLINE HexahedronLanes(const ShearedLanes& lanes, const float (&position)[3][8][kPlaces],
                             std::size_t place)
      : corner_{lanes.At(position, 0, place), lanes.At(position, 1, place),
                lanes.At(position, 2, place), lanes.At(position, 3, place),
                lanes.At(position, 4, place), lanes.At(position, 5, place),
                lanes.At(position, 6, place), lanes.At(position, 7, place)},
        i_{{corner_[0], corner_[1]},
           {corner_[2], corner_[3]},
           {corner_[4], corner_[5]},
           {corner_[6], corner_[7]}},
        j_{{corner_[0], corner_[2]},
           {corner_[1], corner_[3]},
           {corner_[4], corner_[6]},
           {corner_[5], corner_[7]}},
        k_{{corner_[0], corner_[4]},
           {corner_[1], corner_[5]},
           {corner_[2], corner_[6]},
           {corner_[3], corner_[7]}} {
    const ShearedLanes::D d;
    V x = hn::Abs(corner_[0].x), y = hn::Abs(corner_[0].y);
    for (std::size_t c = 1; c < 8; ++c) {
      x = hn::Max(x, hn::Abs(corner_[c].x));
      y = hn::Max(y, hn::Abs(corner_[c].y));
    }
    // Products are off by at most 2^-23 of that, each; below are sums of up to four.
    rounding_ = hn::MulAdd(hn::Mul(x, y), hn::Set(d, 0x1p-20f), hn::Set(d, 0x1p-120f));
  }

  // Of the faces -a, +a, -b, +b, -c, +c.
  HWY_INLINE M MayCross(std::size_t face) const {
    switch (face) {
      case 0:
        return Of(face, j_[0], k_[2], j_[2], k_[0]);
      case 1:
        return Of(face, j_[1], k_[3], j_[3], k_[1]);
      case 2:
        return Of(face, k_[0], i_[2], k_[1], i_[0]);
      case 3:
        return Of(face, k_[2], i_[3], k_[3], i_[1]);
      case 4:
        return Of(face, i_[0], j_[1], i_[1], j_[0]);
      default:
        return Of(face, i_[2], j_[3], i_[3], j_[2]);
    }
  }

 private:
  using Corner = ShearedLanes::Corner;
  using Edge = ShearedLanes::Edge;

  HWY_INLINE M Of(std::size_t face, const Edge& e0, const Edge& e1, const Edge& e2,
                  const Edge& e3) const {
    const ShearedLanes::D d;
    const M odd = hn::Xor(hn::Xor(e0.right, e1.right), hn::Xor(e2.right, e3.right));
    const auto& loop = kCornerLoop[face];
    const Corner &p = corner_[loop[0]], &q = corner_[loop[1]];
    const Corner &r = corner_[loop[2]], &s = corner_[loop[3]];
    const M any_up = hn::Or(hn::Or(p.up, q.up), hn::Or(r.up, s.up));
    const M all_up = hn::And(hn::And(p.up, q.up), hn::And(r.up, s.up));
    const M around = hn::AndNot(odd, hn::AndNot(all_up, any_up));
    if (hn::AllFalse(d, around)) return odd;
    // As is_grazed(), where rounding does not hide it: both edges of a pair on one side of the ray,
    // and the sum of the diagonals' products on the other. Windings of 2 have edges on either side,
    // both up and down.
    auto product = [](const Corner& a, const Corner& b)
                       HWY_ATTR { return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y)); };
    const V ac = product(p, r), bd = product(q, s);
    const V minus = hn::Neg(rounding_);
    auto opposed = [&](V first, V second, V middle) HWY_ATTR {
      const M above =
          hn::And(hn::And(hn::Ge(first, minus), hn::Ge(second, minus)), hn::Le(middle, rounding_));
      const M below = hn::And(hn::And(hn::Le(first, rounding_), hn::Le(second, rounding_)),
                              hn::Ge(middle, minus));
      return hn::Or(above, below);
    };
    const M grazed = hn::And(opposed(product(p, q), product(s, r), hn::Sub(ac, bd)),
                             opposed(product(p, s), product(q, r), hn::Add(ac, bd)));
    const M alternate =
        hn::And(hn::And(hn::Xor(p.up, q.up), hn::Xor(q.up, r.up)), hn::Xor(r.up, s.up));
    return hn::Or(odd, hn::And(around, hn::Or(grazed, alternate)));
  }

  const Corner corner_[8];
  const Edge i_[4], j_[4], k_[4];
  V rounding_;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
