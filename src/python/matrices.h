// Converts numpy arrays to views of the library, if possible without copies.
#pragma once

#include <pybind11/numpy.h>

#include <optional>
#include <string>
#include <vector>

#include "sym3/view.h"

namespace viete::python {

namespace py = pybind11;

/// A contiguous, aligned array in native byte order. Views require this.
template <class T>
using Contiguous =
    py::array_t<T, py::array::c_style | py::array::forcecast | py::detail::npy_api::NPY_ARRAY_ALIGNED_>;

/// The matrices of an array (..., 6) or (..., 3, 3).
struct Shape {
  sym3::Layout layout;
  py::ssize_t axes;   ///< number of axes of a matrix, 1 or 2
  std::size_t count;  ///< number of matrices
};

/// Raises ValueError with the name of the function.
[[noreturn]] void wrong(const char* function, const std::string& what);
std::string shape_text(const py::array& a);

/// Raises ValueError for other shapes.
Shape symmetric_shape(const char* function, const py::array& a);

/// True for float32. False for float64, integers and booleans, which are computed in float64. Raises
/// TypeError for other types.
bool is_single(const char* function, const py::array& a);

/// Calls f with a float if `single` is true, otherwise with a double.
template <class F>
py::object by_type(bool single, const F& f) {
  return single ? f(float{}) : f(double{});
}

/// Converts an object to an array, or returns nullopt if that is not possible. Raises MemoryError.
std::optional<py::array> array_like(const py::handle& a);
/// As array_like(), but raises TypeError if the conversion is not possible.
py::array as_array(const char* function, const py::object& a);

/// Converts numbers to double. Raises TypeError for other types and None. If `finite` is true, raises
/// ValueError with the name `what` for numbers that are not finite.
Contiguous<double> numbers(const char* function, const char* what, const py::object& a, bool finite = true);

/// Weights (..., count), divided by their sum. None gives equal weights. Raises ValueError if the sum is 0.
Contiguous<double> shares(const char* function, const py::object& weights, py::ssize_t count);

bool overlap(const py::array& a, const py::array& b);

/// The result array: `out`, or a new array if `out` is None. Raises TypeError or ValueError, with the name
/// `what`, unless `out` is a writable contiguous array of this shape and type.
template <class T>
py::array_t<T> output(const char* function, const char* what, const py::object& out,
                      const std::vector<py::ssize_t>& shape);

void define_affine(py::module_& m);

}  // namespace viete::python
