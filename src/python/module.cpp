// The Python module `viete`: the library's functions of numpy arrays of matrices.
#include <pybind11/pybind11.h>

#include "python/affine.h"
#include "python/matrices.h"
#include "sym3/exp.h"
#include "sym3/kernel.h"
#include "sym3/log.h"
#include "sym3/polar.h"

namespace viete::python {

namespace {

template <class T>
sym3::SymView<const T> view(const Shape& shape, const Contiguous<T>& a) {
  return {shape.layout, a.data()};
}

template <class T>
sym3::SymView<T> writable_view(const Shape& shape, py::array_t<T>& a) {
  return {shape.layout, a.mutable_data()};
}

/// f(in, out, count) with views of the two arrays' memory, other Python threads running.
template <class T, class F>
py::array apply_as(const char* name, const py::array& a, const py::object& out, const F& f) {
  const auto in = Contiguous<T>::ensure(a);
  if (!in) throw py::error_already_set();
  const Shape shape = symmetric_shape(name, in);
  py::array_t<T> result = output<T>(name, out, in);
  const auto from = view<T>(shape, in);
  const auto to = writable_view<T>(shape, result);
  const py::gil_scoped_release release;
  f(from, to, shape.count);
  return result;
}

template <class F>
py::array apply(const char* name, const py::object& a, const py::object& out, const F& f) {
  const py::array array = as_array(name, a);
  return is_single(name, array) ? apply_as<float>(name, array, out, f)
                                : apply_as<double>(name, array, out, f);
}

constexpr const char* shapes =
    "\n\na: (..., 3, 3), of which the upper triangle is read, or (..., 6), that triangle by rows: xx xy xz "
    "yy yz zz; "
    "float32 or float64 (integers are computed as float64). Contiguous arrays are not copied.\n"
    "out: where the answers go, of the same shape and type; may be a itself.\n"
    "Other Python threads run meanwhile.";

template <class F>
void define(py::module_& m, const char* name, const std::string& text, const F& f) {
  m.def(
      name, [name, f](const py::object& a, const py::object& out) { return apply(name, a, out, f); },
      py::arg("a"), py::arg("out") = py::none(), (text + shapes).c_str());
}

/// Where the two answers of polar go: a pair of arrays, or None for new ones.
struct PolarOutputs {
  py::object rotations = py::none(), stretches = py::none();

  explicit PolarOutputs(const py::object& out) {
    if (out.is_none()) return;
    if (!py::isinstance<py::tuple>(out) || py::len(out) != 2) {
      throw py::value_error("viete.polar: out must be a pair of arrays (r, u)");
    }
    rotations = out.cast<py::tuple>()[0], stretches = out.cast<py::tuple>()[1];
  }
};

template <class T>
py::tuple polar_as(const py::array& a, const PolarOutputs& out) {
  const auto in = Contiguous<T>::ensure(a);
  if (!in) throw py::error_already_set();
  const Shape shape = general_shape("polar", in);
  py::array_t<T> r = output<T>("polar", out.rotations, in), u = output<T>("polar", out.stretches, in);
  if (overlap(u, in) || overlap(u, r))
    throw py::value_error("viete.polar: out's u must be an array of its own");
  const T* m = in.data();
  T *rotations = r.mutable_data(), *stretches = u.mutable_data();
  {
    const py::gil_scoped_release release;
    sym3::polar({shape.layout, m}, {shape.layout, rotations}, {sym3::Layout::full, stretches}, shape.count);
  }
  return py::make_tuple(r, u);
}

py::tuple polar(const py::object& m, const py::object& out) {
  const py::array array = as_array("polar", m);
  const PolarOutputs outputs(out);
  return is_single("polar", array) ? polar_as<float>(array, outputs) : polar_as<double>(array, outputs);
}

}  // namespace

PYBIND11_MODULE(viete, m) {
  m.doc() = "Functions of many symmetric 3x3 matrices, fast and exact.";
  m.attr("__version__") = VIETE_VERSION;
  m.def(
      "kernel", [] { return std::string(sym3::kernel_name()); },
      "The instruction set that runs, such as 'avx512'.");
  define(m, "exp", "The exponential of each matrix.",
         [](const auto& in, const auto& out, std::size_t count) { sym3::exp(in, out, count); });
  define(m, "log", "The logarithm of each matrix; NaN where it is not positive definite.",
         [](const auto& in, const auto& out, std::size_t count) { sym3::log(in, out, count); });
  define(m, "sqrt", "The square root of each matrix; NaN where it is not positive semi-definite.",
         [](const auto& in, const auto& out, std::size_t count) { sym3::sqrt(in, out, count); });
  define(m, "inv_sqrt",
         "The inverse of the square root of each matrix; NaN where it is not positive definite.",
         [](const auto& in, const auto& out, std::size_t count) { sym3::inv_sqrt(in, out, count); });
  m.def(
      "pow",
      [](const py::object& a, double p, const py::object& out) {
        return apply("pow", a, out,
                     [p](const auto& in, const auto& to, std::size_t count) { sym3::pow(in, p, to, count); });
      },
      py::arg("a"), py::arg("p"), py::arg("out") = py::none(),
      (std::string("Each matrix to the power p; NaN where it is not positive definite.") + shapes).c_str());
  m.def(
      "polar", polar, py::arg("m"), py::arg("out") = py::none(),
      "r, u with m = r u for each matrix: r the nearest rotation, whatever the sign of the determinant, and "
      "u symmetric."
      "\n\nm: (..., 3, 3), float32 or float64 (integers are computed as float64).\nout: a pair (r, u) of "
      "arrays "
      "of the same shape and type for the answers; r may be m itself.\nOther Python threads run meanwhile.");
  define_affine(m);
}

}  // namespace viete::python
