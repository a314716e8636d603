// The Python module `viete`: functions on numpy arrays of matrices.
#include <pybind11/pybind11.h>

#include <algorithm>
#include <vector>

#include "python/affine.h"
#include "python/deformation.h"
#include "python/matrices.h"
#include "sym3/derivative.h"
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

/// Calls f(in, out, count) with views of the arrays' memory, without the GIL.
template <class T, class F>
py::array apply_as(const char* name, const py::array& a, const py::object& out, const F& f) {
  const Contiguous<T> in(a);
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
    "\n\na: (..., 3, 3), of which only the upper triangle is read; or (..., 6), the upper triangle by rows: "
    "xx xy xz yy yz zz; float32 or float64 (integers are computed as float64). Contiguous arrays are not "
    "copied.\n"
    "out: an array for the results, of the same shape and type; may be a itself.\n"
    "Releases the GIL.";

template <class F>
void define(py::module_& m, const char* name, const std::string& text, const F& f) {
  m.def(
      name, [name, f](const py::object& a, const py::object& out) { return apply(name, a, out, f); },
      py::arg("a"), py::arg("out") = py::none(), (text + shapes).c_str());
}

/// The results of polar(): a pair of arrays, or None for new ones.
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
  const Contiguous<T> in(a);
  const Shape shape = general_shape("polar", in);
  py::array_t<T> r = output<T>("polar", out.rotations, in), u = output<T>("polar", out.stretches, in);
  if (overlap(u, in) || overlap(u, r))
    throw py::value_error("viete.polar: u in out must not share memory with m or r");
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

/// Directions per matrix: 1 for an array of the same shape, otherwise the length of an additional first axis.
template <class T>
std::size_t directions_at(const std::string& name, const Contiguous<T>& a, const Contiguous<T>& e) {
  const py::ssize_t more = e.ndim() - a.ndim();
  if ((more != 0 && more != 1) || !std::equal(a.shape(), a.shape() + a.ndim(), e.shape() + more)) {
    throw py::value_error("viete." + name +
                          ": directions must have the shape of the matrices, or one more axis in front, the "
                          "number of directions");
  }
  return more ? static_cast<std::size_t>(e.shape(0)) : 1;
}

/// Calls f(matrices, directions, derivatives, count) with views, without the GIL.
template <class T, class F>
py::array derivative_as(const char* name, const py::array& a, const py::array& directions,
                        const py::object& out, const F& f) {
  const Contiguous<T> in(a), e(directions);
  const Shape shape = symmetric_shape(name, in);
  const std::size_t n = directions_at<T>(name, in, e);
  py::array_t<T> result = output<T>(name, out, e);
  if (overlap(result, in))
    throw py::value_error("viete." + std::string(name) + ": out overlaps the matrices");
  const T* from = e.data();
  T* to = result.mutable_data();
  const std::size_t step = static_cast<std::size_t>(in.size());
  std::vector<sym3::SymView<const T>> froms;
  std::vector<sym3::SymView<T>> tos;
  for (std::size_t k = 0; k < n; ++k) {
    froms.emplace_back(shape.layout, from + k * step), tos.emplace_back(shape.layout, to + k * step);
  }
  const auto matrices = view<T>(shape, in);
  const py::gil_scoped_release release;
  f(matrices, sym3::Directions<T>(froms), sym3::Derivatives<T>(tos), shape.count);
  return result;
}

template <class T, class F>
py::array tangent_as(const char* name, const py::array& a, const F& f) {
  const Contiguous<T> in(a);
  const Shape shape = symmetric_shape(name, in);
  std::vector<py::ssize_t> axes(in.shape(),
                                in.shape() + in.ndim() - (shape.layout == sym3::Layout::full ? 2 : 1));
  axes.insert(axes.end(), {6, 6});
  py::array_t<T> result(axes);
  const auto matrices = view<T>(shape, in);
  const sym3::TangentView<T> to(sym3::Layout::packed, result.mutable_data());
  const py::gil_scoped_release release;
  f(matrices, to, shape.count);
  return result;
}

template <class F>
py::array derivative(const char* name, const py::object& a, const py::object& e, const py::object& out,
                     const F& f) {
  const py::array array = as_array(name, a), directions = as_array(name, e);
  const bool single = is_single(name, array) && is_single(name, directions);
  return single ? derivative_as<float>(name, array, directions, out, f)
                : derivative_as<double>(name, array, directions, out, f);
}

template <class F>
py::array tangent(const char* name, const py::object& a, const F& f) {
  const py::array array = as_array(name, a);
  return is_single(name, array) ? tangent_as<float>(name, array, f) : tangent_as<double>(name, array, f);
}

constexpr const char* derivative_text =
    "The derivative of the function at each matrix of `a` in the direction `e`.\n\na: as for the function "
    "itself.\ne: symmetric matrices, an array of the shape of a; for several directions per matrix, with one "
    "more axis in front.\nout: an array for the results, of the shape and type of e; may be e "
    "itself.\nReleases the GIL.";

constexpr const char* tangent_text =
    "All derivatives of the function at each matrix, (..., 6, 6): [..., k, j] is the derivative of component "
    "j of the result by component k of the matrix, both in the order xx xy xz yy yz zz.\n\na: as for the "
    "function itself.\nReleases the GIL.";

template <class Derivative, class Tangent>
void define_derivatives(py::module_& m, const char* derivative_name, const char* tangent_name,
                        const Derivative& by_directions, const Tangent& by_all) {
  m.def(
      derivative_name,
      [derivative_name, by_directions](const py::object& a, const py::object& e, const py::object& out) {
        return derivative(derivative_name, a, e, out, by_directions);
      },
      py::arg("a"), py::arg("e"), py::arg("out") = py::none(), derivative_text);
  m.def(
      tangent_name, [tangent_name, by_all](const py::object& a) { return tangent(tangent_name, a, by_all); },
      py::arg("a"), tangent_text);
}

void define_pow_derivatives(py::module_& m) {
  m.def(
      "pow_derivative",
      [](const py::object& a, double p, const py::object& e, const py::object& out) {
        return derivative("pow_derivative", a, e, out,
                          [p](const auto& s, const auto& from, const auto& to, std::size_t count) {
                            sym3::pow_derivative(s, p, from, to, count);
                          });
      },
      py::arg("a"), py::arg("p"), py::arg("e"), py::arg("out") = py::none(), derivative_text);
  m.def(
      "pow_tangent",
      [](const py::object& a, double p) {
        return tangent("pow_tangent", a, [p](const auto& s, const auto& to, std::size_t count) {
          sym3::pow_tangent(s, p, to, count);
        });
      },
      py::arg("a"), py::arg("p"), tangent_text);
}

// The axis before those of the matrices.
py::ssize_t axis_before(const char* name, const py::array& a) {
  const py::ssize_t of_matrix = symmetric_shape(name, a).layout == sym3::Layout::full ? 2 : 1;
  if (a.ndim() <= of_matrix) wrong(name, "expected several matrices; this shape is " + shape_text(a));
  return a.ndim() - of_matrix - 1;
}

// Appends as many axes of length 1 as matrices have.
py::object spread(const py::object& numbers, py::ssize_t axes) {
  py::object array = py::module_::import("numpy").attr("asarray")(numbers);
  for (py::ssize_t i = 0; i < axes; ++i) array = py::module_::import("numpy").attr("expand_dims")(array, -1);
  return array;
}

py::object exp_of(const py::object& logs) {
  return apply("exp", logs, py::none(),
               [](const auto& in, const auto& to, std::size_t count) { sym3::exp(in, to, count); });
}

py::array log_of(const char* name, const py::object& a) {
  return apply(name, a, py::none(),
               [](const auto& in, const auto& to, std::size_t count) { sym3::log(in, to, count); });
}

// Source: V. Arsigny et al., Log-Euclidean metrics for fast and simple calculus on diffusion tensors, 2006.
py::object mean(const py::object& a, const py::object& weights) {
  const py::array logs = log_of("mean", a);
  const py::ssize_t axis = axis_before("mean", logs);
  if (logs.shape(axis) == 0) wrong("mean", "there are no matrices");
  if (weights.is_none()) return exp_of(logs.attr("mean")(axis));
  const py::array share = shares("mean", weights);
  if (share.shape(share.ndim() - 1) != logs.shape(axis)) {
    wrong("mean", "there are " + std::to_string(logs.shape(axis)) + " matrices; weights have shape " +
                      shape_text(share));
  }
  const py::ssize_t of_matrix = logs.ndim() - axis - 1;
  const py::object weighted = logs * spread(share, of_matrix);
  return exp_of(weighted.attr("sum")(-1 - of_matrix).attr("astype")(logs.dtype()));
}

py::object interpolate(const py::object& a, const py::object& b, const py::object& t) {
  const py::array from = log_of("interpolate", a), to = log_of("interpolate", b);
  const py::ssize_t of_matrix = symmetric_shape("interpolate", from).layout == sym3::Layout::full ? 2 : 1;
  const py::object share =
      spread(finite_numbers("interpolate", "t", t).attr("astype")(from.dtype()), of_matrix);
  return exp_of(from + share * (to - from));
}

void define_means(py::module_& m) {
  m.def("mean", mean, py::arg("a"), py::arg("weights") = py::none(),
        "The log-Euclidean mean, exp(mean(log a)), of (..., k, 3, 3) or (..., k, 6), positive definite.\n\n"
        "weights: (k,) or (..., k), divided by their sum; None: equal weights. Unlike the plain mean it does "
        "not swell: its determinant is the geometric mean of the determinants.");
  m.def("interpolate", interpolate, py::arg("a"), py::arg("b"), py::arg("t"),
        "Interpolates positive definite matrices in log space: exp((1 - t) log a + t log b).\n\n"
        "t: a number, or an array with one for each matrix; shapes broadcast as in numpy.");
}

}  // namespace

PYBIND11_MODULE(viete, m) {
  m.doc() = "Cage-based mesh deformation, and fast, accurate functions of many symmetric 3x3 matrices.";
  m.attr("__version__") = VIETE_VERSION;
  m.def(
      "kernel", [] { return std::string(sym3::kernel_name()); },
      "The instruction set in use, such as 'avx512'.");
  define(m, "exp", "The exponential of each matrix.",
         [](const auto& in, const auto& out, std::size_t count) { sym3::exp(in, out, count); });
  define(m, "log", "The logarithm of each matrix; NaN for matrices that are not positive definite.",
         [](const auto& in, const auto& out, std::size_t count) { sym3::log(in, out, count); });
  define(m, "sqrt", "The square root of each matrix; NaN for matrices that are not positive semi-definite.",
         [](const auto& in, const auto& out, std::size_t count) { sym3::sqrt(in, out, count); });
  define(m, "inv_sqrt",
         "The inverse of the square root of each matrix; NaN for matrices that are not positive definite.",
         [](const auto& in, const auto& out, std::size_t count) { sym3::inv_sqrt(in, out, count); });
  m.def(
      "pow",
      [](const py::object& a, double p, const py::object& out) {
        return apply("pow", a, out,
                     [p](const auto& in, const auto& to, std::size_t count) { sym3::pow(in, p, to, count); });
      },
      py::arg("a"), py::arg("p"), py::arg("out") = py::none(),
      (std::string("Each matrix to the power p; NaN for matrices that are not positive definite.") + shapes)
          .c_str());
#define VIETE_DERIVATIVES_OF(f)                                                \
  define_derivatives(                                                          \
      m, #f "_derivative", #f "_tangent",                                      \
      [](const auto& s, const auto& from, const auto& to, std::size_t count) { \
        sym3::f##_derivative(s, from, to, count);                              \
      },                                                                       \
      [](const auto& s, const auto& to, std::size_t count) { sym3::f##_tangent(s, to, count); })
  VIETE_DERIVATIVES_OF(exp);
  VIETE_DERIVATIVES_OF(log);
  VIETE_DERIVATIVES_OF(sqrt);
#undef VIETE_DERIVATIVES_OF
  define_pow_derivatives(m);
  m.def("polar", polar, py::arg("m"), py::arg("out") = py::none(),
        "The polar decomposition m = r u of each matrix: r the nearest rotation, for any sign of the "
        "determinant, and u symmetric. Returns (r, u).\n\nm: (..., 3, 3), float32 or float64 (integers are "
        "computed as float64).\nout: a pair (r, u) of arrays of the same shape and type for the results; r "
        "may be m itself.\nReleases the GIL.");
  define_means(m);
  define_affine(m);
#ifdef VIETE_HAS_DEFORMER
  define_deformation(m);
#endif
}

}  // namespace viete::python
