// Compositing by the consumer that fits what there is to composite. Compiled once for each
// instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_LIB_COMPOSITE_BY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_LIB_COMPOSITE_BY_INL_H_
#undef PLUME_LIB_COMPOSITE_BY_INL_H_
#else
#define PLUME_LIB_COMPOSITE_BY_INL_H_
#endif
// clang-format on

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "hwy/highway.h"
#include "plume/lib/classified_consumer-inl.h"
#include "plume/lib/volume_consumer-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// A table of any size, its pieces fetched like the points.
template <class Piece>
class FetchedTable {
 public:
  explicit FetchedTable(const std::vector<Piece>& pieces) : first_(&pieces.data()->low) {
    static_assert(sizeof(Piece) % (4 * sizeof(float)) == 0);
  }
  template <std::uint32_t kGroup>
  HWY_INLINE optics::Record four(VU piece) const {
    const DU du;
    constexpr std::uint32_t kPairs = sizeof(Piece) / (2 * sizeof(float));
    HWY_ALIGN std::uint32_t pairs[kMaxLanes];
    hn::Store(hn::Add(hn::Mul(piece, hn::Set(du, kPairs)), hn::Set(du, 2 * kGroup)), du, pairs);
    const FourFloats values = LoadFour(first_, pairs);
    return {values.a, values.b, values.c, values.d};
  }

 private:
  const float* first_;
};

// Calls composite(table) with the table that is had fastest.
template <class Piece, class Composite>
void WithTable(const std::vector<Piece>& pieces, const Composite& composite) {
#if HWY_TARGET != HWY_SCALAR
  // 16 pieces of a classification, for which eight lanes need two permutations an entry.
  constexpr bool kTwo =
      std::is_same_v<Piece, ClassifiedPieces::Piece> && hn::MaxLanes(optics::DF()) == 8;
  using Table = optics::PermutedTable<Piece, kTwo ? 2 : 1>;
  if (Table::fits(pieces)) return composite(Table(pieces));
#endif
  composite(FetchedTable<Piece>(pieces));
}

// Where rays end: no later than where the closed form looks no further.
inline float EnoughOf(const PacketOptics& optics) {
  return std::max(optics.early_termination, optics::kInvisible);
}

// Composites a volume by walk(consumer). `cell_values` is empty where the field is on points.
template <class Walk>
void CompositeVolume(const PacketOptics& optics, const std::vector<float>& cell_values,
                     const Walk& walk) {
  WithTable(optics.volume->pieces, [&](const auto& table) {
    VolumeConsumer<std::decay_t<decltype(table)>> consumer{
        *optics.volume, table, cell_values.empty() ? nullptr : cell_values.data(), EnoughOf(optics),
        optics.colors};
    walk(consumer);
  });
}

// The same of a classification.
template <class Walk>
void CompositeClassified(const PacketOptics& optics, const std::vector<float>& cell_values,
                         const Walk& walk) {
  WithTable(optics.classified->pieces.pieces, [&](const auto& table) {
    ClassifiedConsumer<std::decay_t<decltype(table)>> consumer{
        *optics.classified, table, cell_values.empty() ? nullptr : cell_values.data(),
        EnoughOf(optics), optics.colors};
    walk(consumer);
    consumer.count();
  });
}

// Whichever of the two there is.
template <class Walk>
void CompositeBy(const PacketOptics& optics, const std::vector<float>& cell_values,
                 const Walk& walk) {
  if (optics.classified != nullptr)
    CompositeClassified(optics, cell_values, walk);
  else
    CompositeVolume(optics, cell_values, walk);
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
