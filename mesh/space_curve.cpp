#include "plume/mesh/space_curve.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <utility>

namespace plume {
namespace {

// Skilling's method works bit by bit from the most significant one, and what it has done so far to
// the bits below amounts to a permutation of the axes, the complement of some of them, and whether
// the digit of the key is complemented (the parity that undoes the Gray code): 6 * 8 * 2 states.
struct State {
  int axes[3];  // which of the given coordinates each axis is
  bool complemented[3];
  bool odd;
};

constexpr int kAxes[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
constexpr std::size_t kStates = 96;

constexpr std::uint8_t number_of(const State& state) {
  int permutation = 0;
  while (kAxes[permutation][0] != state.axes[0] || kAxes[permutation][1] != state.axes[1])
    ++permutation;
  int number = permutation;
  for (const bool c : state.complemented) number = 2 * number + c;
  return static_cast<std::uint8_t>(2 * number + state.odd);
}

constexpr State state_of(std::size_t number) {
  const auto& axes = kAxes[number / 16];
  return {{axes[0], axes[1], axes[2]},
          {(number & 8) != 0, (number & 4) != 0, (number & 2) != 0},
          (number & 1) != 0};
}

struct Step {
  unsigned digit;
  State next;
};

// One bit of each coordinate, x's the most significant of the octant, gives one digit of the key.
constexpr Step step(State state, unsigned octant) {
  bool bit[3] = {};
  for (int i = 0; i < 3; ++i)
    bit[i] = (((octant >> (2 - state.axes[i])) & 1) != 0) != state.complemented[i];
  State next = state;
  for (int i = 0; i < 3; ++i) {
    if (bit[i]) {
      next.complemented[0] = !next.complemented[0];
    } else {
      std::swap(next.axes[0], next.axes[i]);
      std::swap(next.complemented[0], next.complemented[i]);
    }
  }
  bit[1] = bit[1] != bit[0];
  bit[2] = bit[2] != bit[1];
  next.odd = state.odd != bit[2];
  unsigned digit = 0;
  for (const bool b : bit) digit = 2 * digit + (b != state.odd);
  return {digit, next};
}

// By the state and an octant, the next state times 8 plus a digit.
constexpr std::array<std::array<std::uint16_t, 8>, kStates> make_single_steps() {
  std::array<std::array<std::uint16_t, 8>, kStates> steps{};
  for (std::size_t s = 0; s < kStates; ++s)
    for (unsigned octant = 0; octant < 8; ++octant) {
      const Step taken = step(state_of(s), octant);
      steps[s][octant] = static_cast<std::uint16_t>(8 * number_of(taken.next) + taken.digit);
    }
  return steps;
}

// Two at once: by the state and two octants, the next state times 64 plus two digits.
constexpr std::array<std::array<std::uint16_t, 64>, kStates> make_steps() {
  constexpr auto kSingle = make_single_steps();
  std::array<std::array<std::uint16_t, 64>, kStates> steps{};
  for (std::size_t s = 0; s < kStates; ++s)
    for (std::size_t octants = 0; octants < 64; ++octants) {
      const std::uint16_t first = kSingle[s][octants / 8];
      const std::uint16_t second = kSingle[first / 8][octants % 8];
      steps[s][octants] = static_cast<std::uint16_t>(second / 8 * 64 + first % 8 * 8 + second % 8);
    }
  return steps;
}

constexpr std::array<std::array<std::uint16_t, 64>, kStates> kSteps = make_steps();
constexpr State kStart{{0, 1, 2}, {false, false, false}, false};
constexpr std::size_t kEvenStart = number_of(kStart);
// The state that a first octant 0, which gives the digit 0, turns into kStart: there are three of
// these in a circle.
constexpr std::size_t kOddStart = number_of(step(step(kStart, 0).next, 0).next);
static_assert(kSteps[kOddStart][0] / 64 == number_of(step(kStart, 0).next));

// Puts two zero bits before each of the lowest 22 bits.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x003F00000000FFFFu;
  x = (x | x << 16) & 0x003F0000FF0000FFu;
  x = (x | x << 8) & 0x300F00F00F00F00Fu;
  x = (x | x << 4) & 0x30C30C30C30C30C3u;
  return (x | x << 2) & 0x9249249249249249u;
}

// So that a key and an item's number share 64 bits.
constexpr int kFinestLattice = 10;

}  // namespace

std::uint64_t hilbert_key(const std::array<float, 3>& position, int order) {
  // The bits of all three in turn.
  std::uint64_t octants = 0;
  const float size = static_cast<float>(1 << order);
  for (const float coordinate : position) {
    const float x = 0.5f * (coordinate + 1.0f) * size;
    octants = octants << 1 | spread(static_cast<std::uint64_t>(static_cast<std::int32_t>(
                                 std::min(std::max(x, 0.0f), size - 1.0f))));
  }
  const int pairs = (order + 1) / 2;
  std::uint64_t key = 0;
  std::size_t state = order % 2 == 0 ? kEvenStart : kOddStart;
  for (int shift = 6 * (pairs - 1); shift >= 0; shift -= 6) {
    const std::uint16_t taken = kSteps[state][(octants >> shift) & 63];
    key = key << 6 | (taken & 63);
    state = taken >> 6;
  }
  return key;
}

int lattice_order(std::size_t count) {
  int order = 1;
  while (order < kFinestLattice && std::uint64_t{1} << (3 * order) < count) ++order;
  return order;
}

std::vector<std::uint32_t> sort_along_curve(
    SortItems items, const std::function<std::array<float, 3>(std::size_t)>& position) {
  const std::size_t count = items.size;
  radix_sort(items, 32, 32 + 3 * lattice_order(count));
  const auto cell = [&](std::size_t i) { return items[i] >> 32; };
  std::vector<std::uint32_t> sorted(count);

  const auto sort_finely = [&](std::size_t begin, std::size_t end) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> crowd(end - begin);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 1024), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const auto item = static_cast<std::uint32_t>(items[i]);
        crowd[i - begin] = {hilbert_key(position(item)), item};
      }
    });
    tbb::parallel_sort(crowd);
    for (std::size_t i = begin; i != end; ++i) sorted[i] = crowd[i - begin].second;
  };
  // A cell of the lattice belongs to the range in which its first item is.
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
    std::size_t i = range.begin();
    while (i != range.end() && i > 0 && cell(i) == cell(i - 1)) ++i;
    while (i < range.end()) {
      std::size_t end = i + 1;
      while (end < count && cell(end) == cell(i)) ++end;
      if (end - i > kCrowdedCell)
        sort_finely(i, end);
      else
        for (std::size_t k = i; k < end; ++k) sorted[k] = static_cast<std::uint32_t>(items[k]);
      i = end;
    }
  });
  return sorted;
}

}  // namespace plume
