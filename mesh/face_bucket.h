/// Faces that have their smallest point in common, matched with each other.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace plume {

/// A hash table with open addressing of the faces around one point (Knuth, "The Art of Computer
/// Programming", vol. 3, 6.4, algorithm L). To be used for one point after another.
class FaceBucket {
 public:
  /// Empties it, for at most so many faces.
  void start(std::size_t faces) {
    const std::size_t size = std::bit_ceil(std::max<std::size_t>(2 * faces, 16));
    shift_ = 64 - std::countr_zero(size);
    if (size > faces_.size()) {
      faces_.resize(size);
      matched_.resize(size);
      keys_.resize(size);
    }
    std::fill_n(faces_.begin(), size, kEmpty);
    mask_ = size - 1;
  }

  /// Adds a face, known by a number below 2^32 - 1, with its second and third smallest point.
  /// Where `same(other, face)` is true of one with equal points that has no partner yet, of the
  /// first such, pair(other, face) is called; where all of them have one, extra(face).
  template <class Same, class Pair, class Extra>
  void add(std::uint32_t second, std::uint32_t third, std::uint32_t face, const Same& same,
           const Pair& pair, const Extra& extra) {
    const std::uint64_t key = std::uint64_t{second} << 32 | third;
    // Multiplicative hashing: 2^64 over the golden ratio (Knuth, 6.4).
    std::size_t place = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15u) >> shift_);
    bool known = false;
    for (; faces_[place] != kEmpty; place = (place + 1) & mask_) {
      if (keys_[place] != key || !same(faces_[place], face)) continue;
      if (!matched_[place]) {
        matched_[place] = true;
        pair(faces_[place], face);
        return;
      }
      known = true;
    }
    if (known) {
      extra(face);
      return;
    }
    faces_[place] = face;
    matched_[place] = false;
    keys_[place] = key;
  }

 private:
  static constexpr std::uint32_t kEmpty = 0xFFFFFFFFu;

  std::vector<std::uint32_t> faces_;
  std::vector<std::uint8_t> matched_;
  std::vector<std::uint64_t> keys_;
  std::size_t mask_ = 0;
  int shift_ = 64;
};

}  // namespace plume
