// Converts numpy arrays to views of the library, without copies if possible.
#pragma once

#include <pybind11/numpy.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sym3/view.h"

namespace viete::python {

namespace py = pybind11;

/// A contiguous, aligned array in native byte order. Views need this kind of array.
template <class T>
using Contiguous =
    py::array_t<T, py::array::c_style | py::array::forcecast | py::detail::npy_api::NPY_ARRAY_ALIGNED_>;

/// The layout of the matrices in an array (..., 6) or (..., 3, 3).
struct Shape {
  sym3::Layout layout;
  py::ssize_t axes;   ///< number of axes of a matrix, 1 or 2
  std::size_t count;  ///< number of matrices
};

/// Python gets it as viete.Error, a ValueError.
struct WrongValue : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// Throws WrongValue with the name of the function.
[[noreturn]] void wrong(const char* function, const std::string& what);
/// Returns f(), which calls numpy. Raises viete.Error with numpy's message if shapes do not fit.
template <class F>
auto with_numpy(const char* function, const F& f) {
  try {
    return f();
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError)) throw;
    wrong(function, py::str(error.value()));
  }
}
std::string shape_text(const py::array& a);

/// Returns the layout of the matrices. Raises viete.Error for other shapes.
Shape symmetric_shape(const char* function, const py::array& a);

/// Returns true for float32, and false for float64, integers and booleans, which are computed in float64.
/// Raises TypeError for other types.
bool is_single(const char* function, const py::array& a);

/// If `single` is true, calls f with a float, otherwise with a double.
template <class F>
py::object by_type(bool single, const F& f) {
  return single ? f(float{}) : f(double{});
}

/// Converts an object to an array. If that is not possible, returns nullopt. Raises MemoryError.
std::optional<py::array> array_like(const py::handle& a);
/// Works like array_like(), but if the conversion is not possible, raises TypeError.
py::array as_array(const char* function, const py::object& a);

/// Converts numbers to double. Raises TypeError for other types and None. If `finite` is true and a number is
/// not finite, raises viete.Error with the name `what`.
Contiguous<double> numbers(const char* function, const char* what, const py::object& a, bool finite = true);

/// Returns weights (..., count) divided by their sum. None gives equal weights. A sum of 0 raises
/// viete.Error.
Contiguous<double> shares(const char* function, const py::object& weights, py::ssize_t count);

bool overlap(const py::array& a, const py::array& b);

/// Returns `out`, or a new array if `out` is None. If `out` is not a writable contiguous array of this shape
/// and type, raises TypeError or viete.Error with the name `what`.
template <class T>
py::array_t<T> output(const char* function, const char* what, const py::object& out,
                      const std::vector<py::ssize_t>& shape);

void define_affine(py::module_& m);

}  // namespace viete::python
