// Conversion between numpy arrays and views of the library, without copies where possible.
#pragma once

#include <pybind11/numpy.h>

#include <optional>
#include <string>
#include <vector>

#include "sym3/view.h"

namespace viete::python {

namespace py = pybind11;

/// A contiguous, aligned array in native byte order, as views need it.
template <class T>
using Contiguous =
    py::array_t<T, py::array::c_style | py::array::forcecast | py::detail::npy_api::NPY_ARRAY_ALIGNED_>;

/// The layout, own axes and number of matrices, from an array of shape (..., 6) or (..., 3, 3).
struct Shape {
  sym3::Layout layout;
  py::ssize_t axes;
  std::size_t count;
};

/// Raises ValueError that names the function.
[[noreturn]] void wrong(const char* function, const std::string& what);
std::string shape_text(const py::array& a);

/// Raises ValueError that names the function for other shapes.
Shape symmetric_shape(const char* function, const py::array& a);

/// True for float32; false for float64, and for integers and booleans, which are computed as float64. Raises
/// TypeError for other types.
bool is_single(const char* function, const py::array& a);

/// Calls f with a number of the type of the computation.
template <class F>
py::object by_type(bool single, const F& f) {
  return single ? f(float{}) : f(double{});
}

/// Converts an array-like; empty if it is none. Raises MemoryError.
std::optional<py::array> array_like(const py::handle& a);
/// The same, but raises TypeError if it is not array-like.
py::array as_array(const char* function, const py::object& a);

/// Converts to double. Raises TypeError for other types, including None; and, if `finite`, ValueError for
/// numbers that are not, called `what`.
Contiguous<double> numbers(const char* function, const char* what, const py::object& a, bool finite = true);

/// Weights (..., count), divided by their sum; equal ones for None. Raises ValueError if they sum to 0.
Contiguous<double> shares(const char* function, const py::object& weights, py::ssize_t count);

/// True if the arrays share memory.
bool overlap(const py::array& a, const py::array& b);

/// The result array: `out`, or a new array if it is None. Raises TypeError or ValueError unless `out`, called
/// `what`, is a writable contiguous array of this shape and type.
template <class T>
py::array_t<T> output(const char* function, const char* what, const py::object& out,
                      const std::vector<py::ssize_t>& shape);

/// Defines the functions of affine maps.
void define_affine(py::module_& m);

}  // namespace viete::python
