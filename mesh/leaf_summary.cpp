#include "plume/mesh/leaf_summary.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/mesh/leaf_summary.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

// Plain loops over the cells of a leaf, of which compilers make vectors: as wide as the instruction
// set's that they are compiled for here.
HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kLeaf = kLeafCells;

// A bit for each cell whose volume is not positive, or that is somewhere thinner than kLeastWidth.
// A cell's width is six times its volume divided by twice the area of a face, or by the cross
// product of two opposite edges. Rounding is far below what a point may be moved by.
unsigned ThinCells(const LeafCells& p) {
  constexpr float kSquared = kLeastWidth * kLeastWidth;
  alignas(64) int wide[kLeaf];
  for (std::size_t i = 0; i < kLeaf; ++i) {
    const float ax = p.position[0][1][i] - p.position[0][0][i],
                ay = p.position[1][1][i] - p.position[1][0][i];
    const float az = p.position[2][1][i] - p.position[2][0][i];
    const float bx = p.position[0][2][i] - p.position[0][0][i],
                by = p.position[1][2][i] - p.position[1][0][i];
    const float bz = p.position[2][2][i] - p.position[2][0][i];
    const float cx = p.position[0][3][i] - p.position[0][0][i],
                cy = p.position[1][3][i] - p.position[1][0][i];
    const float cz = p.position[2][3][i] - p.position[2][0][i];
    const float abx = ay * bz - az * by, aby = az * bx - ax * bz, abz = ax * by - ay * bx;
    const float bcx = by * cz - bz * cy, bcy = bz * cx - bx * cz, bcz = bx * cy - by * cx;
    const float cax = cy * az - cz * ay, cay = cz * ax - cx * az, caz = cx * ay - cy * ax;
    const float sign = (p.odd >> i & 1) != 0 ? -1.0f : 1.0f;
    const float volume = sign * (abx * cx + aby * cy + abz * cz);
    auto squared = [](float x, float y, float z) { return x * x + y * y + z * z; };
    const float squares[7] = {squared(abx, aby, abz),
                              squared(bcx, bcy, bcz),
                              squared(cax, cay, caz),
                              squared(abx + bcx, aby + bcy, abz + bcz),
                              squared(bcx + cax, bcy + cay, bcz + caz),
                              squared(cax + abx, cay + aby, caz + abz),
                              squared(abx + bcx + cax, aby + bcy + cay, abz + bcz + caz)};
    float largest = squares[0];
    for (std::size_t s = 1; s < 7; ++s) largest = squares[s] > largest ? squares[s] : largest;
    wide[i] =
        static_cast<int>(volume > 0) & static_cast<int>(volume * volume >= kSquared * largest);
  }
  unsigned thin = 0;
  for (std::size_t i = 0; i < kLeaf; ++i) thin |= (wide[i] != 0 ? 0u : 1u) << i;
  return thin;
}

// Halving, so that compilers use vectors. Destroys the values.
float LeastOf(float* values) {
  for (std::size_t half = kLeaf / 2; half > 0; half /= 2)
    for (std::size_t i = 0; i < half; ++i)
      values[i] = values[half + i] < values[i] ? values[half + i] : values[i];
  return values[0];
}
float GreatestOf(float* values) {
  for (std::size_t half = kLeaf / 2; half > 0; half /= 2)
    for (std::size_t i = 0; i < half; ++i)
      values[i] = values[half + i] > values[i] ? values[half + i] : values[i];
  return values[0];
}

// The leaf's range, and the cells' in sixteenths of it.
void TakeRanges(const LeafCells& cells, LeafSummary& summary) {
  float least[kLeaf], greatest[kLeaf], lows[kLeaf], highs[kLeaf];
  LeafCells::bound(cells.scalar, least, greatest);
  for (std::size_t i = 0; i < kLeaf; ++i) widen_range(least[i], greatest[i]);
  // Where a cell has no value, widening makes NaN, which is never less than anything.
  for (std::size_t i = 0; i < kLeaf; ++i) {
    lows[i] = least[i] < kInfinity ? least[i] : kInfinity;
    highs[i] = greatest[i] > -kInfinity ? greatest[i] : -kInfinity;
  }
  summary.least = LeastOf(lows);
  summary.greatest = GreatestOf(highs);
  const CellHierarchy::Sixteenths sixteenths(summary.least, summary.greatest);
  int first[kLeaf], last[kLeaf];
  for (std::size_t i = 0; i < kLeaf; ++i) {
    first[i] = sixteenths.of(least[i]);
    last[i] = sixteenths.of(greatest[i]);
  }
  for (std::size_t i = 0; i < kLeaf; ++i)
    summary.ranges[i] =
        static_cast<std::uint8_t>(least[i] <= greatest[i] ? first[i] | last[i] << 4 : 15);
}

LeafSummary Summarize(const LeafCells& cells) {
  LeafSummary summary;
  for (std::size_t a = 0; a < 3; ++a) {
    float lows[kLeaf], highs[kLeaf];
    LeafCells::bound(cells.position[a], lows, highs);
    summary.low[a] = LeastOf(lows);
    summary.high[a] = GreatestOf(highs);
  }
  summary.thin = ThinCells(cells);
  TakeRanges(cells, summary);
  return summary;
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(Summarize);

LeafSummary summarize(const LeafCells& cells) { return HWY_DYNAMIC_DISPATCH(Summarize)(cells); }

}  // namespace plume
#endif
