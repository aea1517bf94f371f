/// Position along a Hilbert curve, bit by bit.
#pragma once

#include <array>
#include <cstdint>

namespace plume::reference {

/// Key of a cell of a lattice of 2^order cells along each axis, order from 1 to 21. J. Skilling,
/// "Programming the Hilbert curve" (AIP Conf. Proc. 707, 2004): AxestoTranspose, then the bits of
/// the three numbers in turn.
inline std::uint64_t hilbert_key(std::array<std::uint32_t, 3> x, int order) {
  for (std::uint32_t q = 1u << (order - 1); q > 1; q >>= 1) {
    const std::uint32_t p = q - 1;
    for (auto& axis : x) {
      if (axis & q) {
        x[0] ^= p;
      } else {
        const std::uint32_t t = (x[0] ^ axis) & p;
        x[0] ^= t;
        axis ^= t;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1u << (order - 1); q > 1; q >>= 1)
    if (x[2] & q) t ^= q - 1;
  std::uint64_t key = 0;
  for (int bit = order - 1; bit >= 0; --bit)
    for (const auto axis : x) key = (key << 1) | (((axis ^ t) >> bit) & 1u);
  return key;
}

}  // namespace plume::reference
