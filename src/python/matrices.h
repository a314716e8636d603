// Conversion between numpy arrays and views of the library, without copies where possible.
#pragma once

#include <pybind11/numpy.h>

#include <optional>
#include <string>

#include "sym3/view.h"

namespace viete::python {

namespace py = pybind11;

/// A contiguous, aligned array in native byte order, as views need it.
template <class T>
using Contiguous =
    py::array_t<T, py::array::c_style | py::array::forcecast | py::detail::npy_api::NPY_ARRAY_ALIGNED_>;

/// The layout and number of matrices, from an array of shape (..., 6) or (..., 3, 3).
struct Shape {
  sym3::Layout layout;
  std::size_t count;
};

/// Raises ValueError that names the function.
[[noreturn]] void wrong(const char* function, const std::string& what);
std::string shape_text(const py::array& a);

/// For symmetric matrices in either form. Raises ValueError that names the function for other shapes.
Shape symmetric_shape(const char* function, const py::array& a);
/// For general matrices, (..., 3, 3) only.
Shape general_shape(const char* function, const py::array& a);

/// True for float32; false for float64, and for integers and booleans, which are computed as float64. Raises
/// TypeError for other types.
bool is_single(const char* function, const py::array& a);

/// Converts an array-like; empty if it is none. Raises MemoryError.
std::optional<py::array> array_like(const py::handle& a);
/// The same, but raises TypeError if it is not array-like.
py::array as_array(const char* function, const py::object& a);

/// Converts to a contiguous double array. Raises TypeError for non-numbers, including None, and ValueError
/// for non-finite numbers.
py::array_t<double, py::array::c_style | py::array::forcecast> finite_numbers(const char* function,
                                                                              const char* what,
                                                                              const py::object& a);

/// Finite weights, (..., k), divided by their sum over the last axis without overflow. Raises ValueError if
/// they sum to 0.
py::array_t<double, py::array::c_style | py::array::forcecast> shares(const char* function,
                                                                      const py::object& weights);

/// True if the arrays share memory.
bool overlap(const py::array& a, const py::array& b);

/// The result array: `out`, or a new array if it is None. Raises TypeError or ValueError unless `out` is a
/// writable contiguous array of the shape and type of `in`, and either `in` itself or without shared memory.
template <class T>
py::array_t<T> output(const char* function, const py::object& out, const Contiguous<T>& in);

}  // namespace viete::python
