// In what order a bundle of rays looks at cells, and at which. Compiled once for each instruction
// set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_SEARCH_ORDER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_SEARCH_ORDER_INL_H_
#undef PLUME_TRAVERSE_SEARCH_ORDER_INL_H_
#else
#define PLUME_TRAVERSE_SEARCH_ORDER_INL_H_
#endif
// clang-format on

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "hwy/highway.h"
#include "plume/traverse/cell_search.h"
#include "plume/traverse/hull_test-inl.h"
#include "plume/traverse/ray_bundle.h"
#include "plume/traverse/sheared_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// All that matters and all that is special, or one of the two.
enum class SearchPass { all, special, inside };

// What TreeSearch asks, for a target (see segment_target.h).
template <class Target>
class SearchOrder {
 public:
  SearchOrder(const RayBundle& bundle, Target& target)
      : bundle_(bundle),
        hull_(bundle, bundle.hull()),
        forwards_(bundle.sign() > 0),
        target_(target) {
    for (std::size_t group = 0; group * ShearedLanes::Lanes() < bundle.size(); ++group)
      hulls_[group] = HullTest(
          bundle, bundle.hull(group * ShearedLanes::Lanes(),
                              std::min(bundle.size(), (group + 1) * ShearedLanes::Lanes())));
  }

  float limit() const { return target_.limit(); }
  template <class D>
  HWY_INLINE hn::Mask<D> Matters(D d, const float* least, const float* greatest) const {
    if constexpr (Target::kKey != CellKey::place)
      return hn::Le(hn::Load(d, least), hn::Load(d, greatest));
    auto matters = hn::MaskFromVec(hn::Zero(d));
    for (const ScalarWindow& window : target_.windows())
      matters = hn::Or(matters, hn::And(hn::Lt(hn::Load(d, least), hn::Set(d, window.below)),
                                        hn::Ge(hn::Load(d, greatest), hn::Set(d, window.from))));
    return matters;
  }
  template <class D>
  HWY_INLINE hn::Vec<D> Keys(D d, const float* low, const float* high, const float* least,
                             const float* greatest) const {
    if constexpr (Target::kKey == CellKey::place)
      return forwards_ ? hn::Load(d, low) : hn::Neg(hn::Load(d, high));
    else if (pass_ == SearchPass::special)
      return hn::Set(d, -std::numeric_limits<float>::infinity());
    else
      return Target::kKey == CellKey::least ? hn::Load(d, least) : hn::Neg(hn::Load(d, greatest));
  }
  // Of the `wanted` cells of a leaf calls visit(place, first_ray, lanes, near) for those that a
  // vector of rays, first_ray and following, may meet, and tells those for which they may matter.
  template <class Leaf, class Visit>
  HWY_INLINE void ForEachNear(const Leaf& leaf, std::uint32_t wanted, const Visit& visit) const {
    const HWY_CAPPED(float, 16) d;
    const ShearedLanes::D rays_of;
    constexpr std::size_t kCells = std::extent_v<decltype(leaf.least)>;
    const std::size_t z = hull_.axis();
    HWY_ALIGN float keys[kCells];
    for (std::size_t from = 0; from < kCells; from += hn::Lanes(d))
      hn::Store(
          Keys(d, leaf.low[z] + from, leaf.high[z] + from, leaf.least + from, leaf.greatest + from),
          d, keys + from);
    for (std::size_t group = 0; group * ShearedLanes::Lanes() < bundle_.size(); ++group) {
      const std::size_t first_ray = group * ShearedLanes::Lanes();
      const float* const limits = target_.limits() + first_ray;
      const float limit = hn::GetLane(hn::MaxOfLanes(rays_of, hn::Load(rays_of, limits)));
      std::uint32_t cells = 0;
      for (std::size_t from = 0; from < kCells; from += hn::Lanes(d))
        cells |= BitsOf(d, hn::And(hulls_[group].Meets(d, leaf.low, leaf.high, from),
                                   hn::Lt(hn::Load(d, keys + from), hn::Set(d, limit))))
                 << from;
      cells &= wanted;
      if (cells == 0) continue;
      const ShearedLanes lanes(bundle_, first_ray);
      for (; cells != 0; cells &= cells - 1) {
        const auto place = static_cast<std::uint32_t>(__builtin_ctz(cells));
        visit(place, first_ray, lanes,
              hn::Lt(hn::Set(rays_of, keys[place]), hn::Load(rays_of, limits)));
      }
    }
  }
  std::uint32_t Opens(std::uint32_t matters, std::uint32_t special) const {
    return pass_ == SearchPass::special  ? special
           : pass_ == SearchPass::inside ? matters
                                         : matters | special;
  }

 protected:
  const RayBundle& bundle_;
  const HullTest hull_;
  const bool forwards_;
  Target& target_;
  HullTest hulls_[RayBundle::kRays];  // of as many rays as a vector has lanes
  SearchPass pass_ = SearchPass::all;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
