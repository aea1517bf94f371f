/// What a fuzzer hands over, taken apart piece by piece. Past the end there are zeros.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace plume::fuzz {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

  bool empty() const { return left_.empty(); }
  std::size_t size() const { return left_.size(); }

  template <class T>
  T take() {
    T value{};
    const std::size_t count = left_.size() < sizeof(T) ? left_.size() : sizeof(T);
    if (count > 0) std::memcpy(&value, left_.data(), count);
    left_ = left_.subspan(count);
    return value;
  }
  /// 0 to count - 1.
  std::size_t below(std::size_t count) { return take<std::uint8_t>() % count; }
  /// -1 to 1 in steps of 1/64: coordinates that coincide and line up.
  double coarse() { return static_cast<double>(take<std::int8_t>() % 65) / 64; }

 private:
  std::span<const std::uint8_t> left_;
};

/// Ends the process, which is what a fuzzer takes for a finding.
[[noreturn]] void fail(const char* what);

}  // namespace plume::fuzz
