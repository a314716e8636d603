#include "python/matrices.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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
  throw py::value_error("viete." + std::string(function) + ": " + what);
}

py::array_t<double, py::array::c_style | py::array::forcecast> finite_numbers(const char* function,
                                                                              const char* what,
                                                                              const py::object& a) {
  const py::array array = as_array(function, a);
  is_single(function, array);
  py::array_t<double, py::array::c_style | py::array::forcecast> numbers(array);
  for (py::ssize_t i = 0; i < numbers.size(); ++i)
    if (!std::isfinite(numbers.data()[i]))
      wrong(function, std::string(what) + " contains a number that is not finite");
  return numbers;
}

py::array_t<double, py::array::c_style | py::array::forcecast> shares(const char* function,
                                                                      const py::object& weights) {
  auto numbers = finite_numbers(function, "weights", weights);
  if (numbers.ndim() == 0) wrong(function, "weights must be (k,) or (..., k)");
  py::array_t<double> result(std::vector<py::ssize_t>(numbers.shape(), numbers.shape() + numbers.ndim()));
  const py::ssize_t count = numbers.shape(numbers.ndim() - 1);
  for (py::ssize_t row = 0; row < numbers.size(); row += count) {
    const double* w = numbers.data() + row;
    double* share = result.mutable_data() + row;
    double largest = 0, size = 0, sum = 0;
    for (py::ssize_t i = 0; i < count; ++i) largest = std::max(largest, std::abs(w[i]));
    const int exponent = largest > 0 ? std::ilogb(largest) : 0;  // the sum may overflow, or be subnormal
    for (py::ssize_t i = 0; i < count; ++i) {
      share[i] = std::scalbn(w[i], -exponent);
      sum += share[i], size += std::abs(share[i]);
    }
    if (std::abs(sum) <= 0x1p-53 * static_cast<double>(count) * size) wrong(function, "the weights sum to 0");
    for (py::ssize_t i = 0; i < count; ++i) share[i] /= sum;
  }
  return result;
}

bool overlap(const py::array& a, const py::array& b) {
  const auto* first = static_cast<const char*>(a.data());
  const auto* second = static_cast<const char*>(b.data());
  return first < second + b.nbytes() && second < first + a.nbytes();
}

Shape symmetric_shape(const char* function, const py::array& a) {
  if (ends_in_3_3(a)) return {sym3::Layout::full, product(a, a.ndim() - 2)};
  if (a.ndim() >= 1 && a.shape(a.ndim() - 1) == 6) return {sym3::Layout::packed, product(a, a.ndim() - 1)};
  wrong(function, "matrices must be (..., 3, 3) or (..., 6), the upper triangle by rows; this shape is " +
                      shape_text(a));
}

Shape general_shape(const char* function, const py::array& a) {
  if (ends_in_3_3(a)) return {sym3::Layout::packed, product(a, a.ndim() - 2)};
  wrong(function, "matrices must be (..., 3, 3); this shape is " + shape_text(a));
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

template <class T>
py::array_t<T> output(const char* function, const py::object& out, const Contiguous<T>& in) {
  const std::vector<py::ssize_t> shape(in.shape(), in.shape() + in.ndim());
  if (out.is_none()) return py::array_t<T>(shape);
  if (!py::isinstance<py::array>(out)) {
    wrong_type(function, "out must be an array; this is a " + text_of(py::type::of(out).attr("__name__")));
  }
  const auto array = py::reinterpret_borrow<py::array>(out);
  if (!array.dtype().is(py::dtype::of<T>()) && !py::dtype::of<T>().equal(array.dtype())) {
    wrong_type(function,
               "out is " + text_of(array.dtype()) + ", the results are " + text_of(py::dtype::of<T>()));
  }
  if (array.ndim() != in.ndim() || !std::equal(shape.begin(), shape.end(), array.shape())) {
    wrong(function, "out has shape " + shape_text(array) + ", the matrices " + shape_text(in));
  }
  if (!array.writeable()) wrong(function, "out is read-only");
  if (!(array.flags() & py::array::c_style) || !(array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_)) {
    wrong(function, "out is not contiguous and aligned");
  }
  if (array.data() != in.data() && overlap(array, in))
    wrong(function, "out overlaps the matrices; only in place is allowed");
  return py::reinterpret_borrow<py::array_t<T>>(out);
}

template py::array_t<float> output(const char*, const py::object&, const Contiguous<float>&);
template py::array_t<double> output(const char*, const py::object&, const Contiguous<double>&);

}  // namespace viete::python
