// How a bundle of rays goes through a tree of clusters, front to back. Compiled once for each
// instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_TREE_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_TREE_SEARCH_INL_H_
#undef PLUME_TRAVERSE_TREE_SEARCH_INL_H_
#else
#define PLUME_TRAVERSE_TREE_SEARCH_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>
#include <limits>

#include "hwy/highway.h"
#include "plume/mesh/cluster_tree.h"
#include "plume/traverse/hull_test-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Calls search.Leaf(number, matters) for the leaves of a tree that the bundle may meet, those with
// the least keys first, more or less. Of boxes and ranges that lie side by side a search says
// - Keys(d, lows, highs, least, greatest), lows and highs along the rays' axis; nothing is opened
//   whose key is not below limit(), which may change;
// - Matters(d, least, greatest), and of bits for a node's children that do, and of those that are
//   special, which to open: Opens(matters, special).
// AskFor(leaf) says that a leaf may come soon.
template <class Search>
class TreeSearch {
 public:
  TreeSearch(const ClusterTree& tree, const HullTest& hull, Search& search)
      : tree_(tree), hull_(hull), search_(search) {}

  void Run() {
    if (tree_.depth() == 0) return;
    stack_[0] = {-std::numeric_limits<float>::infinity(), tree_.depth(), 0, true};
    size_ = 1;
    while (size_ > 0) {
      const Item item = stack_[--size_];
      if (!(item.key < search_.limit())) continue;
      if (item.level == 0)
        search_.Leaf(item.index, item.matters);
      else
        Open(item);
    }
  }

 private:
  // A node of that level, counted from 1; 0 is a leaf. Where its range does not matter, what is
  // special in it does.
  struct Item {
    float key;
    std::uint32_t level, index;
    bool matters;
  };

  // Puts the children that matter on the stack, that with the least key on top.
  HWY_INLINE void Open(const Item& item) {
    const HWY_CAPPED(float, ClusterTree::kWidth) d;
    const std::uint32_t number = tree_.levels[item.level - 1] + item.index;
    const ClusterTree::Node& node = tree_.nodes[number];
    const auto limit = hn::Set(d, search_.limit());
    const std::size_t z = hull_.axis();
    std::uint32_t matters = 0, meets = 0;
    HWY_ALIGN float keys[ClusterTree::kWidth];
    for (std::size_t from = 0; from < ClusterTree::kWidth; from += hn::Lanes(d)) {
      const auto key = search_.Keys(d, node.low[z] + from, node.high[z] + from, node.least + from,
                                    node.greatest + from);
      hn::Store(key, d, keys + from);
      matters |= BitsOf(d, search_.Matters(d, node.least + from, node.greatest + from)) << from;
      meets |= BitsOf(d, hn::And(hull_.Meets(d, node.low, node.high, from), hn::Lt(key, limit)))
               << from;
    }
    std::uint32_t open = meets & search_.Opens(matters, tree_.special[number]);
    const std::size_t begin = size_;
    for (; open != 0; open &= open - 1) {
      const auto child = static_cast<std::uint32_t>(__builtin_ctz(open));
      std::size_t place = size_++;
      for (; place > begin && stack_[place - 1].key < keys[child]; --place)
        stack_[place] = stack_[place - 1];
      stack_[place] = {keys[child], item.level - 1,
                       static_cast<std::uint32_t>(ClusterTree::kWidth) * item.index + child,
                       (matters >> child & 1) != 0};
      if (item.level == 1)
        search_.AskFor(stack_[place].index);
      else
        AskForNode(item.level - 1, stack_[place].index);
    }
  }

  void AskForNode(std::uint32_t level, std::uint32_t index) const {
    const auto* const node =
        reinterpret_cast<const char*>(&tree_.nodes[tree_.levels[level - 1] + index]);
    for (std::size_t line = 0; line < sizeof(ClusterTree::Node); line += 64)
      __builtin_prefetch(node + line);
  }

  const ClusterTree& tree_;
  const HullTest& hull_;
  Search& search_;
  // Of each level at most all children but the one that is being opened.
  Item stack_[12 * ClusterTree::kWidth];
  std::size_t size_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
