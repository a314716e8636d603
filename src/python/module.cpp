// The Python module `viete`: functions of matrices in numpy arrays.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "python/matrices.h"
#ifdef VIETE_HAS_DEFORMER
#include "python/meshes.h"
#endif
#include "sym3/decomposition.h"
#include "sym3/derivative.h"
#include "sym3/exp.h"
#include "sym3/kernel.h"
#include "sym3/log.h"
#include "sym3/polar.h"

namespace viete::python {

namespace {

/// Returns `out`. If `out` is None, returns a new array with the shape and type of `in`.
template <class T>
py::array_t<T> result_of(const char* name, const py::object& out, const Contiguous<T>& in) {
  py::array_t<T> result = output<T>(name, "out", out, {in.shape(), in.shape() + in.ndim()});
  if (result.data() != in.data() && overlap(result, in))
    wrong(name, "out overlaps the matrices; pass the same array or another one");
  return result;
}

/// Calls f(in, out, count) with views of the arrays, without the GIL.
template <class F>
py::object apply(const char* name, const py::object& a, const py::object& out, const F& f) {
  const py::array array = as_array(name, a);
  return by_type(is_single(name, array), [&]<class T>(T) -> py::object {
    const Contiguous<T> in(array);
    const Shape shape = symmetric_shape(name, in);
    py::array_t<T> result = result_of<T>(name, out, in);
    const sym3::SymView<const T> from(shape.layout, in.data());
    const sym3::SymView<T> to(shape.layout, result.mutable_data());
    const py::gil_scoped_release release;
    f(from, to, shape.count);
    return result;
  });
}

/// Returns the number of directions for each matrix: the length of the additional first axis of `e`. If `e`
/// has no additional axis, returns 1.
std::size_t directions_at(const char* name, const py::array& a, const py::array& e) {
  const py::ssize_t more = e.ndim() - a.ndim();
  if ((more != 0 && more != 1) || !std::equal(a.shape(), a.shape() + a.ndim(), e.shape() + more))
    wrong(name, "directions must have the shape of the matrices, or this shape after one more axis in front");
  return more ? static_cast<std::size_t>(e.shape(0)) : 1;
}

/// Calls f(matrices, directions, derivatives, count) with views of the arrays, without the GIL.
template <class F>
py::object derivative(const char* name, const py::object& a, const py::object& e, const py::object& out,
                      const F& f) {
  const py::array array = as_array(name, a), directions = as_array(name, e);
  const bool single = is_single(name, array) && is_single(name, directions);
  return by_type(single, [&]<class T>(T) -> py::object {
    const Contiguous<T> in(array), along(directions);
    const Shape shape = symmetric_shape(name, in);
    const std::size_t n = directions_at(name, in, along), step = static_cast<std::size_t>(in.size());
    py::array_t<T> result = result_of<T>(name, out, along);
    if (overlap(result, in)) wrong(name, "out overlaps the matrices");
    const T* from = along.data();
    T* to = result.mutable_data();
    std::vector<sym3::SymView<const T>> froms;
    std::vector<sym3::SymView<T>> tos;
    for (std::size_t k = 0; k < n; ++k) {
      froms.emplace_back(shape.layout, from + k * step);
      tos.emplace_back(shape.layout, to + k * step);
    }
    const sym3::SymView<const T> matrices(shape.layout, in.data());
    const py::gil_scoped_release release;
    f(matrices, sym3::Directions<T>(froms), sym3::Derivatives<T>(tos), shape.count);
    return result;
  });
}

/// Returns the shape of `in` with other axes in place of those of its matrices.
template <class T>
std::vector<py::ssize_t> axes_of(const Contiguous<T>& in, py::ssize_t own,
                                 std::initializer_list<py::ssize_t> instead) {
  std::vector<py::ssize_t> axes(in.shape(), in.shape() + in.ndim() - own);
  axes.insert(axes.end(), instead);
  return axes;
}

template <class F>
py::object tangent(const char* name, const py::object& a, const F& f) {
  const py::array array = as_array(name, a);
  return by_type(is_single(name, array), [&]<class T>(T) -> py::object {
    const Contiguous<T> in(array);
    const Shape shape = symmetric_shape(name, in);
    py::array_t<T> result(axes_of(in, shape.axes, {6, 6}));
    const sym3::SymView<const T> matrices(shape.layout, in.data());
    const sym3::TangentView<T> to(sym3::Layout::packed, result.mutable_data());
    const py::gil_scoped_release release;
    f(matrices, to, shape.count);
    return result;
  });
}

py::object polar(const py::object& m, const std::optional<std::pair<py::object, py::object>>& out) {
  const py::array array = as_array("polar", m);
  return by_type(is_single("polar", array), [&]<class T>(T) -> py::object {
    const Contiguous<T> in(array);
    if (symmetric_shape("polar", in).layout != sym3::Layout::full)
      wrong("polar", "matrices must be (..., 3, 3); this shape is " + shape_text(in));
    py::array_t<T> r = result_of<T>("polar", out ? out->first : py::none(), in),
                   u = result_of<T>("polar", out ? out->second : py::none(), in);
    if (overlap(u, in) || overlap(u, r)) wrong("polar", "u in out must not share memory with m or r");
    const sym3::MatView<const T> from(sym3::Layout::packed, in.data());
    const sym3::MatView<T> rotations(sym3::Layout::packed, r.mutable_data());
    const sym3::SymView<T> stretches(sym3::Layout::full, u.mutable_data());
    {
      const py::gil_scoped_release release;
      sym3::polar(from, rotations, stretches, static_cast<std::size_t>(in.size()) / 9);
    }
    return py::make_tuple(r, u);
  });
}

py::object eigh(const py::object& a) {
  const py::array array = as_array("eigh", a);
  return by_type(is_single("eigh", array), [&]<class T>(T) -> py::object {
    const Contiguous<T> in(array);
    const Shape shape = symmetric_shape("eigh", in);
    py::array_t<T> values(axes_of(in, shape.axes, {3})), vectors(axes_of(in, shape.axes, {3, 3}));
    const sym3::SymView<const T> from(shape.layout, in.data());
    const sym3::VecView<T> to_values(sym3::Layout::packed, values.mutable_data());
    const sym3::MatView<T> to_vectors(sym3::Layout::packed, vectors.mutable_data());
    {
      const py::gil_scoped_release release;
      sym3::eigh(from, to_values, to_vectors, shape.count);
    }
    return py::make_tuple(values, vectors);
  });
}

/// Makes negative last values positive, by a change of the sign of the last column of u, as numpy does.
template <class T>
void make_positive(std::size_t count, T* u, T* values) {
  for (; count > 0; --count, u += 9, values += 3) {
    const T sign = values[2] < 0 ? T(-1) : T(1);
    for (T* number : {values + 2, u + 2, u + 5, u + 8}) *number *= sign;
  }
}

py::object svd(const py::object& m, bool is_signed) {
  const py::array array = as_array("svd", m);
  return by_type(is_single("svd", array), [&]<class T>(T) -> py::object {
    const Contiguous<T> in(array);
    const Shape shape = symmetric_shape("svd", in);
    if (shape.layout != sym3::Layout::full)
      wrong("svd", "matrices must be (..., 3, 3); this shape is " + shape_text(in));
    const auto nine = axes_of(in, 2, {3, 3});
    py::array_t<T> u(nine), v(nine), values(axes_of(in, 2, {3}));
    T *const to_u = u.mutable_data(), *const to_v = v.mutable_data(),
             *const to_values = values.mutable_data();
    const T* const from = in.data();
    {
      const py::gil_scoped_release release;
      constexpr auto packed = sym3::Layout::packed;
      sym3::svd({packed, from}, {packed, to_u}, {packed, to_values}, {packed, to_v}, shape.count);
      if (!is_signed) make_positive(shape.count, to_u, to_values);
    }
    return py::make_tuple(u, values, v.attr("swapaxes")(-1, -2));
  });
}

py::object log_of(const char* name, const py::object& a) {
  return apply(name, a, py::none(), [](const auto&... v) { sym3::log(v...); });
}

/// Returns exp(base + sum of weight * log). If axes is "k", the sum is over axis k: weights are (..., k), and
/// logs are (..., k, 3, 3) or (..., k, 6). If axes is "", there is one term and no axis k.
py::object exp_of_sum(const char* name, const py::object& base, const char* axes, const py::object& weights,
                      const py::array& logs) {
  const std::string own = symmetric_shape(name, logs).axes == 2 ? "ij" : "i";
  const py::str text = "...{0},...{0}{1}->...{1}";
  const py::object exponent = with_numpy(name, [&] {
    const py::object sum = py::module_::import("numpy").attr("einsum")(text.format(axes, own), weights, logs);
    return (base + sum).attr("astype")(logs.dtype());
  });
  return apply(name, exponent, py::none(), [](const auto&... v) { sym3::exp(v...); });
}

// Source: V. Arsigny et al., Log-Euclidean metrics for fast and simple calculus on diffusion tensors, 2006.
py::object mean(const py::object& a, const py::object& weights) {
  const py::array logs = log_of("mean", a);
  const py::ssize_t axis = logs.ndim() - symmetric_shape("mean", logs).axes - 1;
  if (axis < 0) wrong("mean", "expected several matrices; this shape is " + shape_text(logs));
  return exp_of_sum("mean", py::int_(0), "k", shares("mean", weights, logs.shape(axis)), logs);
}

py::object interpolate(const py::object& a, const py::object& b, const py::object& t) {
  const py::object from = log_of("interpolate", a), to = log_of("interpolate", b);
  const py::object difference = with_numpy("interpolate", [&] { return to - from; });
  return exp_of_sum("interpolate", from, "", numbers("interpolate", "t", t), difference);
}

constexpr const char* shapes =
    "\n\na: (..., 3, 3), of which only the upper triangle is read, or (..., 6), the upper triangle by rows: "
    "xx xy xz yy yz zz. float32 or float64; integers are converted to float64. Contiguous arrays are not "
    "copied.\n"
    "out: an array of the same shape and type for the results. It may be a.\n"
    "Releases the GIL.";

constexpr const char* derivative_text =
    "The derivative of the function at each matrix of a, in the direction e.\n\na: as for the function.\n"
    "e: symmetric matrices with the shape of a. For several directions for each matrix, one more axis in "
    "front.\n"
    "out: an array with the shape and type of e for the results. It may be e.\nReleases the GIL.";

constexpr const char* tangent_text =
    "All derivatives of the function at each matrix, (..., 6, 6): [..., k, j] is the derivative of number j "
    "of the result by number k of the matrix, in the order xx xy xz yy yz zz.\n\na: as for the function.\n"
    "Releases the GIL.";

// Defines a function of matrices. Further parameters have the types P and the names `extra`.
template <class... P, class F, class... Extra>
void define(py::module_& m, const char* name, const F& f, const std::string& text, const Extra&... extra) {
  const auto call = [=](const py::object& a, P... p, const py::object& out) {
    return apply(name, a, out, [&](const auto& in, const auto& to, auto n) { f(in, p..., to, n); });
  };
  m.def(name, call, py::arg("a"), extra..., py::arg("out") = py::none(), (text + shapes).c_str());
}

template <class... P, class F, class... Extra>
void define_derivative(py::module_& m, const char* name, const F& f, const Extra&... extra) {
  const auto call = [=](const py::object& a, P... p, const py::object& e, const py::object& out) {
    return derivative(name, a, e, out, [&](const auto& s, const auto& from, const auto& to, auto n) {
      f(s, p..., from, to, n);
    });
  };
  m.def(name, call, py::arg("a"), extra..., py::arg("e"), py::arg("out") = py::none(), derivative_text);
}

template <class... P, class F, class... Extra>
void define_tangent(py::module_& m, const char* name, const F& f, const Extra&... extra) {
  const auto call = [=](const py::object& a, P... p) {
    return tangent(name, a, [&](const auto& s, const auto& to, auto n) { f(s, p..., to, n); });
  };
  m.def(name, call, py::arg("a"), extra..., tangent_text);
}

}  // namespace

PYBIND11_MODULE(viete, m) {
  m.doc() = "Cage-based mesh deformation, and fast, accurate functions of many symmetric 3x3 matrices.";
  m.attr("__version__") = VIETE_VERSION;
  py::register_local_exception<WrongValue>(m, "Error", PyExc_ValueError).attr("__doc__") =
      "Raised for invalid files and arrays; the message says what is wrong and what to do.";
  py::register_local_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
      PyErr_SetString(PyExc_MemoryError, "not enough memory; close other programs or use a smaller model");
    }
  });
  m.def(
      "kernel", [] { return std::string(sym3::kernel_name()); },
      "The instruction set in use, for example 'avx512'.");
  const std::string nan_unless_positive = "; NaN for matrices that are not positive definite.";
  const auto p = py::arg("p");
#define VIETE_NAMED(f) #f, [](const auto&... v) { sym3::f(v...); }
  define(m, VIETE_NAMED(exp), "The exponential of each matrix.");
  define(m, VIETE_NAMED(log), "The logarithm of each matrix" + nan_unless_positive);
  define(m, VIETE_NAMED(sqrt),
         "The square root of each matrix; NaN for matrices that are not positive semi-definite.");
  define(m, VIETE_NAMED(inv_sqrt), "The inverse of the square root of each matrix" + nan_unless_positive);
  define<double>(m, VIETE_NAMED(pow), "Each matrix to the power p" + nan_unless_positive, p);
  define_derivative(m, VIETE_NAMED(exp_derivative));
  define_derivative(m, VIETE_NAMED(log_derivative));
  define_derivative(m, VIETE_NAMED(sqrt_derivative));
  define_derivative<double>(m, VIETE_NAMED(pow_derivative), p);
  define_tangent(m, VIETE_NAMED(exp_tangent));
  define_tangent(m, VIETE_NAMED(log_tangent));
  define_tangent(m, VIETE_NAMED(sqrt_tangent));
  define_tangent<double>(m, VIETE_NAMED(pow_tangent), p);
#undef VIETE_NAMED
  m.def("polar", polar, py::arg("m"), py::arg("out") = py::none(),
        "The polar decomposition m = r u of each matrix: r is the nearest rotation, for any sign of the "
        "determinant, and u is symmetric. Returns (r, u).\n\nm: (..., 3, 3), float32 or float64; integers "
        "are converted to float64.\nout: a pair (r, u) of arrays with the shape and type of m for the "
        "results. r may be m.\nReleases the GIL.");
  m.def(
      "eigh", eigh, py::arg("a"),
      "Eigenvalues and eigenvectors of each symmetric matrix, as numpy.linalg.eigh. Returns (w, v): w "
      "ascends, and the column v[..., :, k] belongs to w[..., k]. v is a rotation; the largest components of "
      "its columns 1 and 2 are positive. NaN for matrices that are not finite. Releases the GIL.");
  m.def(
      "svd", svd, py::arg("m"), py::arg("signed") = false,
      "The singular value decomposition m = (u * s[..., None, :]) @ vh of each matrix, as numpy.linalg.svd. "
      "Returns (u, s, vh): s descends and is not negative.\n\n"
      "m: (..., 3, 3), float32 or float64; integers are converted to float64.\nsigned: if true, u and vh are "
      "rotations, and the last value has the sign of the determinant.\nReleases the GIL.");
  m.def("mean", mean, py::arg("a"), py::arg("weights") = py::none(),
        "The log-Euclidean mean exp(mean(log a)) of positive definite matrices, (..., k, 3, 3) or (..., k, "
        "6). Its determinant is the geometric mean of the determinants.\n\n"
        "weights: (k,) or (..., k), divided by their sum. None means equal weights.");
  m.def("interpolate", interpolate, py::arg("a"), py::arg("b"), py::arg("t"),
        "Interpolates positive definite matrices in log space: exp((1 - t) log a + t log b).\n\n"
        "t: a number, or an array with a number for each matrix. Shapes broadcast as in numpy.");
  define_affine(m);
#ifdef VIETE_HAS_DEFORMER
  define_deformation(m);
#endif
}

}  // namespace viete::python
