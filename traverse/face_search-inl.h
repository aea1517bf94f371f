// How a bundle of rays meets the faces at a mesh's boundary. Compiled once for each instruction
// set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_FACE_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_FACE_SEARCH_INL_H_
#undef PLUME_TRAVERSE_FACE_SEARCH_INL_H_
#else
#define PLUME_TRAVERSE_FACE_SEARCH_INL_H_
#endif
// clang-format on

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hwy/highway.h"
#include "plume/mesh/boundary_clusters.h"
#include "plume/mesh/cluster_tree.h"
#include "plume/traverse/cluster_cache.h"
#include "plume/traverse/leaf_cache.h"
#include "plume/traverse/ray_bundle.h"
#include "plume/traverse/sheared_lanes-inl.h"
#include "plume/traverse/tree_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Hands to the target the faces at the boundary that its rays cross, or may cross where they are no
// triangles, front to back, more or less. `Faces` is FaceCache or FaceBoxCache.
template <class Faces, class Target>
class FaceSearch {
 public:
  FaceSearch(Faces& faces, const RayBundle& bundle, const HullTest& hull, Target& target)
      : faces_(faces),
        bundle_(bundle),
        hull_(hull),
        forwards_(bundle.sign() > 0),
        target_(target) {}

  void Run() { TreeSearch<FaceSearch>(faces_.tree(), hull_, *this).Run(); }

  float limit() const { return target_.limit(); }
  template <class D>
  HWY_INLINE hn::Vec<D> Keys(D d, const float* low, const float* high, const float* /*least*/,
                             const float* /*greatest*/) const {
    if (Target::kKey != CellKey::place) return hn::Set(d, -std::numeric_limits<float>::infinity());
    return forwards_ ? hn::Load(d, low) : hn::Neg(hn::Load(d, high));
  }
  template <class D>
  HWY_INLINE hn::Mask<D> Matters(D d, const float* least, const float* greatest) const {
    return hn::Le(hn::Load(d, least), hn::Load(d, greatest));
  }
  std::uint32_t Opens(std::uint32_t matters, std::uint32_t /*special*/) const { return matters; }
  void AskFor(std::uint32_t leaf) const { faces_.ask_for(leaf); }

  void Leaf(std::uint32_t number, bool /*matters*/) {
    const HWY_CAPPED(float, kLeafFaces) d;
    const auto& leaf = faces_.read(number);
    HWY_ALIGN float keys[kLeafFaces];
    std::uint32_t meets = 0;
    const auto limit = hn::Set(d, target_.limit());
    for (std::size_t from = 0; from < kLeafFaces; from += hn::Lanes(d)) {
      const auto key =
          Keys(d, leaf.low[hull_.axis()] + from, leaf.high[hull_.axis()] + from, nullptr, nullptr);
      hn::Store(key, d, keys + from);
      meets |= BitsOf(d, hn::And(hull_.Meets(d, leaf.low, leaf.high, from), hn::Lt(key, limit)))
               << from;
    }
    meets &= (1u << leaf.size) - 1;
    if (meets == 0) return;
    for (std::size_t first = 0; first < bundle_.size(); first += ShearedLanes::Lanes()) {
      const ShearedLanes lanes(bundle_, first);
      const auto limits = hn::Load(ShearedLanes::D(), target_.limits() + first);
      for (std::uint32_t left = meets; left != 0; left &= left - 1) {
        const auto place = static_cast<std::uint32_t>(__builtin_ctz(left));
        std::uint32_t rays = BitsOf(ShearedLanes::D(),
                                    hn::And(hn::Lt(hn::Set(ShearedLanes::D(), keys[place]), limits),
                                            Crosses(lanes, leaf, place)));
        for (; rays != 0; rays &= rays - 1)
          target_.cross_boundary(first + static_cast<std::size_t>(__builtin_ctz(rays)),
                                 faces_.number_of(leaf, place));
      }
    }
  }

 private:
  HWY_INLINE static ShearedLanes::M Crosses(const ShearedLanes& lanes, const ReadCluster& leaf,
                                            std::size_t place) {
    return lanes.Meets(leaf.low, leaf.high, place);
  }
  HWY_INLINE static ShearedLanes::M Crosses(const ShearedLanes& lanes, const LeafFaces& leaf,
                                            std::size_t place) {
    using Edge = ShearedLanes::Edge;
    const auto a = lanes.At(leaf.position, 0, place), b = lanes.At(leaf.position, 1, place);
    const auto c = lanes.At(leaf.position, 2, place);
    return hn::Xor(hn::Xor(Edge(a, b).right, Edge(b, c).right), Edge(c, a).right);
  }

  Faces& faces_;
  const RayBundle& bundle_;
  const HullTest& hull_;
  const bool forwards_;
  Target& target_;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
