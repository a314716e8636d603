#include "python/matrices.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "sym3/affine.h"

namespace viete::python {

namespace {

std::string text_of(const py::handle& object) {
  return py::str(object).cast<std::string>();
}

std::size_t product(const py::array& a, py::ssize_t axes) {
  std::size_t count = 1;
  for (py::ssize_t i = 0; i < axes; ++i) count *= static_cast<std::size_t>(a.shape(i));
  return count;
}

bool ends_in_3_3(const py::array& a) {
  return a.ndim() >= 2 && a.shape(a.ndim() - 1) == 3 && a.shape(a.ndim() - 2) == 3;
}

[[noreturn]] void wrong_type(const char* function, const std::string& what) {
  throw py::type_error("viete." + std::string(function) + ": " + what);
}

}  // namespace

std::string shape_text(const py::array& a) {
  return text_of(a.attr("shape"));
}

void wrong(const char* function, const std::string& what) {
  throw WrongValue("viete." + std::string(function) + ": " + what);
}

bool overlap(const py::array& a, const py::array& b) {
  const auto* first = static_cast<const char*>(a.data());
  const auto* second = static_cast<const char*>(b.data());
  return first < second + b.nbytes() && second < first + a.nbytes();
}

Shape symmetric_shape(const char* function, const py::array& a) {
  if (ends_in_3_3(a)) return {sym3::Layout::full, 2, product(a, a.ndim() - 2)};
  if (a.ndim() >= 1 && a.shape(a.ndim() - 1) == 6) return {sym3::Layout::packed, 1, product(a, a.ndim() - 1)};
  wrong(function, "matrices must be (..., 3, 3) or (..., 6), the upper triangle by rows; this shape is " +
                      shape_text(a));
}

bool is_single(const char* function, const py::array& a) {
  const char kind = a.dtype().kind();
  if (kind == 'f' && a.itemsize() == sizeof(float)) return true;
  if (kind == 'f' && a.itemsize() == sizeof(double)) return false;
  if (kind == 'i' || kind == 'u' || kind == 'b') return false;
  wrong_type(function, "entries must be float32, float64 or integers; these are " + text_of(a.dtype()));
}

std::optional<py::array> array_like(const py::handle& a) {
  try {
    return py::array(py::reinterpret_borrow<py::object>(a));
  } catch (const py::error_already_set& error) {
    if (error.matches(PyExc_MemoryError)) throw;
    return std::nullopt;
  }
}

py::array as_array(const char* function, const py::object& a) {
  if (auto array = array_like(a)) return *std::move(array);
  wrong_type(function, "expected an array; this is a " + text_of(py::type::of(a).attr("__name__")));
}

Contiguous<double> numbers(const char* function, const char* what, const py::object& a, bool finite) {
  const py::array array = as_array(function, a);
  is_single(function, array);
  const Contiguous<double> result(array);
  const std::span all(result.data(), static_cast<std::size_t>(result.size()));
  if (finite && !std::ranges::all_of(all, [](double x) { return std::isfinite(x); }))
    wrong(function, std::string(what) + " contains a number that is not finite");
  return result;
}

Contiguous<double> shares(const char* function, const py::object& weights, py::ssize_t count) {
  if (count == 0) wrong(function, "there are no matrices");
  const auto size = static_cast<std::size_t>(count);
  const Contiguous<double> given =
      numbers(function, "weights", weights.is_none() ? py::cast(std::vector<double>(size, 1)) : weights);
  if (given.ndim() == 0 || given.shape(given.ndim() - 1) != count)
    wrong(function,
          "there are " + std::to_string(count) + " matrices; weights have shape " + shape_text(given));
  Contiguous<double> result(std::vector<py::ssize_t>(given.shape(), given.shape() + given.ndim()));
  for (py::ssize_t row = 0; row < given.size(); row += count) {
    const double* w = given.data() + row;
    const auto [shift, sum] = sym3::sum_of({w, size});
    if (sum == 0) wrong(function, "the weights sum to 0");
    std::transform(w, w + size, result.mutable_data() + row,
                   [shift, sum](double x) { return std::scalbn(x, -shift) / sum; });
  }
  return result;
}

template <class T>
py::array_t<T> output(const char* function, const char* what, const py::object& out,
                      const std::vector<py::ssize_t>& shape) {
  if (out.is_none()) return py::array_t<T>(shape);
  const auto name = [&] { return std::string(what); };
  if (!py::isinstance<py::array>(out))
    wrong_type(function,
               name() + " must be an array; this is a " + text_of(py::type::of(out).attr("__name__")));
  const auto array = py::reinterpret_borrow<py::array>(out);
  if (!py::dtype::of<T>().equal(array.dtype()))
    wrong_type(function,
               name() + " is " + text_of(array.dtype()) + ", the results are " + text_of(py::dtype::of<T>()));
  if (!std::equal(shape.begin(), shape.end(), array.shape(), array.shape() + array.ndim()))
    wrong(function, name() + " has shape " + shape_text(array) + ", the results have " +
                        text_of(py::tuple(py::cast(shape))));
  if (!array.writeable()) wrong(function, name() + " is read-only");
  if (!(array.flags() & py::array::c_style) || !(array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_))
    wrong(function, name() + " is not contiguous and aligned");
  return py::reinterpret_borrow<py::array_t<T>>(out);
}

template py::array_t<float> output(const char*, const char*, const py::object&,
                                   const std::vector<py::ssize_t>&);
template py::array_t<double> output(const char*, const char*, const py::object&,
                                    const std::vector<py::ssize_t>&);

}  // namespace viete::python
