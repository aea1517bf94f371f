// The corners of hexahedral cells, a cell a lane. Compiled once for each instruction set: to be
// included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_HEXAHEDRON_CORNERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_HEXAHEDRON_CORNERS_INL_H_
#undef PLUME_TRAVERSE_HEXAHEDRON_CORNERS_INL_H_
#else
#define PLUME_TRAVERSE_HEXAHEDRON_CORNERS_INL_H_
#endif
// clang-format on

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "hwy/highway.h"
#include "plume/mesh/walkable_cells.h"
#include "plume/mesh/walkable_grid.h"
#include "plume/traverse/lane_loads-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// The corners of the lanes' cells: corner a + 2b + 4c has the parameters (a, b, c).
class GridCorners {
 public:
  explicit GridCorners(const WalkableGrid& mesh)
      : points_(mesh.points.data()->position),
        dimensions_{mesh.dimensions[0], mesh.dimensions[1]} {}

  // Which lanes have none.
  HWY_INLINE MF Load(VU cells, FourFloats (&corner)[8]) const {
    const DU du;
    const VU row = Quotient(cells, dimensions_[0] - 1), plane = Quotient(row, dimensions_[1] - 1);
    const VU ni = hn::Set(du, dimensions_[0]);
    // i + ni (j + nj k), where the cell is i + (ni - 1) (j + (nj - 1) k).
    const VU first = hn::Add(hn::Add(cells, row), hn::Mul(ni, plane));
    for (std::uint32_t c = 0; c < 8; ++c) {
      const std::uint32_t further =
          (c & 1) + (c >> 1 & 1) * dimensions_[0] + (c >> 2) * dimensions_[0] * dimensions_[1];
      HWY_ALIGN std::uint32_t pairs[kMaxLanes];
      hn::Store(hn::ShiftLeft<1>(hn::Add(first, hn::Set(du, further))), du, pairs);
      corner[c] = LoadFour(points_, pairs);
    }
    return hn::MaskFromVec(hn::Zero(DF()));
  }

 private:
  // Of numbers below 2^31. Two guesses by single precision leave an error of one.
  static HWY_INLINE VU Quotient(VU number, std::uint32_t divisor) {
    const DF d;
    const DU du;
    const hn::RebindToSigned<DF> di;
    const auto by = hn::Set(di, static_cast<std::int32_t>(divisor));
    const VF inverse = hn::Set(d, 1.0f / static_cast<float>(divisor));
    const auto n = hn::BitCast(di, number);
    auto guess = [&](auto left) {
      return hn::ConvertTo(di, hn::Mul(hn::ConvertTo(d, left), inverse));
    };
    auto quotient = guess(n);
    quotient = hn::Add(quotient, guess(hn::Sub(n, hn::Mul(quotient, by))));
    const auto left = hn::Sub(n, hn::Mul(quotient, by));
    // A mask is -1 where it holds.
    quotient = hn::Add(quotient, hn::VecFromMask(di, hn::Lt(left, hn::Zero(di))));
    quotient = hn::Sub(quotient, hn::VecFromMask(di, hn::Not(hn::Lt(left, by))));
    return hn::BitCast(du, quotient);
  }

  const float* points_;
  const std::uint32_t dimensions_[2];
};

// A wedge, a pyramid or a tetrahedron is a hexahedron some of whose corners coincide, and its
// interpolation that hexahedron's.
class CellCorners {
 public:
  explicit CellCorners(const WalkableCells& mesh)
      : cells_(mesh.corner_cells.data()), points_(mesh.points.data()->position) {}

  HWY_INLINE MF Load(VU cells, FourFloats (&corner)[8]) const {
    const DF d;
    const DU du;
    static_assert(sizeof(CornerCell) == 16 * sizeof(std::uint32_t));
    const VU record = hn::ShiftLeft<3>(cells);  // in steps of two words
    HWY_ALIGN std::uint32_t pairs[kMaxLanes];
    auto words = [&](std::uint32_t from) {
      hn::Store(hn::Add(record, hn::Set(du, from / 2)), du, pairs);
      return LoadFour(reinterpret_cast<const float*>(cells_), pairs);
    };
    auto load = [&](VF id) {
      hn::Store(hn::ShiftLeft<1>(hn::BitCast(du, id)), du, pairs);
      return LoadFour(points_, pairs);
    };
    for (std::uint32_t half = 0; half < 2; ++half) {
      const FourFloats ids = words(4 * half);
      corner[4 * half] = load(ids.a);
      corner[4 * half + 1] = load(ids.b);
      corner[4 * half + 2] = load(ids.c);
      corner[4 * half + 3] = load(ids.d);
    }
    const VU other = hn::BitCast(du, words(12).c);
    return hn::RebindMask(d, hn::Ne(other, hn::Zero(du)));
  }

 private:
  const CornerCell* cells_;
  const float* points_;
};

template <class Mesh>
using CornersOf = std::conditional_t<std::is_same_v<Mesh, WalkableGrid>, GridCorners, CellCorners>;

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
