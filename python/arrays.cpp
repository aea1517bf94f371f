#include "arrays.h"

#include <memory>

namespace plume::python {
namespace {

namespace py = pybind11;

// Holds a Python object; given up by whichever thread is the last to need it.
std::shared_ptr<const void> kept(const py::object& object) {
  auto* const held = new py::object(object);
  return {held, [](const void* pointer) {
            const py::gil_scoped_acquire gil;
            delete static_cast<const py::object*>(pointer);
          }};
}

template <class T>
Array borrow_as(const py::array& values) {
  return Array::borrow(std::span<const T>(static_cast<const T*>(values.data()),
                                          static_cast<std::size_t>(values.size())),
                       kept(values));
}

}  // namespace

Array borrow(const py::array& values, const std::string& name) {
  if ((values.flags() & py::array::c_style) != 0) {
    if (py::isinstance<py::array_t<std::uint8_t>>(values)) return borrow_as<std::uint8_t>(values);
    if (py::isinstance<py::array_t<std::int32_t>>(values)) return borrow_as<std::int32_t>(values);
    if (py::isinstance<py::array_t<std::int64_t>>(values)) return borrow_as<std::int64_t>(values);
    if (py::isinstance<py::array_t<float>>(values)) return borrow_as<float>(values);
    if (py::isinstance<py::array_t<double>>(values)) return borrow_as<double>(values);
  }
  throw Error(name + ": an array of " + std::string(py::str(values.dtype())) +
              " that cannot be read where it is; give a contiguous one of uint8, int32, int64, "
              "float32 or float64");
}

py::array view(const Array& values, std::vector<py::ssize_t> shape, const py::object& owner) {
  return values.visit([&](auto span) {
    using T = std::remove_const_t<typename decltype(span)::element_type>;
    py::array_t<T> result(shape, span.data(), owner);
    result.attr("flags").attr("writeable") = false;
    return static_cast<py::array>(std::move(result));
  });
}

}  // namespace plume::python
