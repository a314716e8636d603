// From numpy arrays to views of the library and back, without copies where the memory allows it.
#pragma once

#include <pybind11/numpy.h>

#include <optional>
#include <string>

#include "sym3/view.h"

namespace viete::python {

namespace py = pybind11;

/// Floating point numbers in the machine's order, one after the other: what a view can see.
template <class T>
using Contiguous =
    py::array_t<T, py::array::c_style | py::array::forcecast | py::detail::npy_api::NPY_ARRAY_ALIGNED_>;

/// Many matrices as the last one or two axes of an array say: (..., 6) or (..., 3, 3).
struct Shape {
  sym3::Layout layout;
  std::size_t count;
};

/// Raises ValueError that names the function.
[[noreturn]] void wrong(const char* function, const std::string& what);
std::string shape_text(const py::array& a);

/// Symmetric matrices in either form. Raises ValueError, naming the function, for any other shape.
Shape symmetric_shape(const char* function, const py::array& a);
/// General matrices, (..., 3, 3) only.
Shape general_shape(const char* function, const py::array& a);

/// True for float32, false for float64 and for integers and booleans, which are computed as float64. Raises
/// TypeError for any other.
bool is_single(const char* function, const py::array& a);

/// Any array-like as an array; nothing if it is none. Raises MemoryError.
std::optional<py::array> array_like(const py::handle& a);
/// The same; raises TypeError if it is none.
py::array as_array(const char* function, const py::object& a);

/// The array of numbers in double, one after the other: weights, or steps. Raises TypeError for what is none,
/// as None is, and ValueError where one is not finite.
py::array_t<double, py::array::c_style | py::array::forcecast> finite_numbers(const char* function,
                                                                              const char* what,
                                                                              const py::object& a);

/// Finite weights, (..., k), divided by their sum over the last axis, whatever their size. Raises ValueError
/// where they sum to 0.
py::array_t<double, py::array::c_style | py::array::forcecast> shares(const char* function,
                                                                      const py::object& weights);

/// Whether two arrays share memory.
bool overlap(const py::array& a, const py::array& b);

/// Where the answers go: `out`, or a new array of that shape if it is None. Raises TypeError or ValueError
/// unless `out` is a writable contiguous array of the same shape and type that is `in` itself or shares no
/// memory with it.
template <class T>
py::array_t<T> output(const char* function, const py::object& out, const Contiguous<T>& in);

}  // namespace viete::python
