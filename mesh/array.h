/// A contiguous array of numbers, owned or borrowed, whose type is known at run time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace plume {

/// Holds `size()` values of one of five types. Copies are shallow: they share the values.
///
/// An array made by `own` keeps its values alive; one made by `borrow` reads the caller's memory,
/// which must outlive the array and everything it was copied into, unless a `keep_alive` is given.
/// The values are never written to.
class Array {
 public:
  /// Of the values.
  enum class Type : std::uint8_t { uint8, int32, int64, float32, float64 };

  Array() = default;

  /// Takes the values, which may be of any of the five types.
  template <class T>
  static Array own(std::vector<T> values) {
    auto held = std::make_shared<const std::vector<T>>(std::move(values));
    return Array(held->data(), held->size(), type_of<T>(), held);
  }

  /// Reads the caller's memory, which `keep_alive`, if given, holds for as long as it is needed.
  template <class T>
  static Array borrow(std::span<const T> values, std::shared_ptr<const void> keep_alive = {}) {
    return Array(values.data(), values.size(), type_of<T>(), std::move(keep_alive));
  }

  std::size_t size() const { return size_; }  ///< values, not bytes
  bool empty() const { return size_ == 0; }   ///< whether there are none
  Type type() const { return type_; }         ///< of each value
  const void* data() const { return data_; }  ///< where the first is

  /// Calls `f` with the values as a std::span<const T> of their true type: one dispatch for a whole
  /// loop. `f` must return the same type for every T.
  template <class F>
  decltype(auto) visit(F&& f) const {
    switch (type_) {
      case Type::uint8:
        return f(span<std::uint8_t>());
      case Type::int32:
        return f(span<std::int32_t>());
      case Type::int64:
        return f(span<std::int64_t>());
      case Type::float32:
        return f(span<float>());
      case Type::float64:
        break;
    }
    return f(span<double>());
  }

  /// One value, converted. For loops, prefer visit().
  template <class T>
  T at(std::size_t i) const {
    return visit([i](auto values) { return static_cast<T>(values[i]); });
  }

  /// Bytes of one value.
  std::size_t value_bytes() const {
    return visit([](auto values) { return sizeof(values[0]); });
  }

 private:
  Array(const void* data, std::size_t size, Type type, std::shared_ptr<const void> keep_alive)
      : keep_alive_(std::move(keep_alive)), data_(data), size_(size), type_(type) {}

  template <class T>
  static constexpr Type type_of() {
    if constexpr (std::is_same_v<T, std::uint8_t>)
      return Type::uint8;
    else if constexpr (std::is_same_v<T, float>)
      return Type::float32;
    else if constexpr (std::is_same_v<T, double>)
      return Type::float64;
    else if constexpr (std::is_integral_v<T> && std::is_signed_v<T> && sizeof(T) == 4)
      return Type::int32;
    else {
      static_assert(std::is_integral_v<T> && std::is_signed_v<T> && sizeof(T) == 8,
                    "an Array holds uint8, int32, int64, float or double");
      return Type::int64;
    }
  }

  template <class T>
  std::span<const T> span() const {
    return {static_cast<const T*>(data_), size_};
  }

  std::shared_ptr<const void> keep_alive_;
  const void* data_ = nullptr;
  std::size_t size_ = 0;
  Type type_ = Type::float32;
};

}  // namespace plume
