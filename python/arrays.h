// NumPy's arrays and Plume's, which share their memory both ways.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <utility>
#include <vector>

#include "plume/lib/plume.h"

namespace plume::python {

/// Reads the array where it is, and keeps it alive for as long as anybody may read it. Its values
/// must be uint8, int32, int64, float32 or float64 in the machine's byte order, contiguous in C's
/// order: the Python side has seen to that. Throws Error, naming the array, where they are not.
Array borrow(const pybind11::array& values, const std::string& name);

/// A read-only view of an Array in NumPy, which `owner` keeps alive.
pybind11::array view(const Array& values, std::vector<pybind11::ssize_t> shape,
                     const pybind11::object& owner);

/// A NumPy array that owns what was a vector: its memory is handed over, not copied.
template <class T>
pybind11::array_t<T> hand_over(std::vector<T> values, std::vector<pybind11::ssize_t> shape) {
  auto* const held = new std::vector<T>(std::move(values));
  const pybind11::capsule owner(
      held, [](void* pointer) { delete static_cast<std::vector<T>*>(pointer); });
  return pybind11::array_t<T>(std::move(shape), held->data(), owner);
}

}  // namespace plume::python
