#include <pybind11/stl.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <span>
#include <type_traits>

#include "python/matrices.h"
#include "sym3/affine.h"
#include "sym3/general.h"

namespace viete::python {

namespace {

using sym3::Affine, sym3::AffineLog;
using Axes = std::vector<py::ssize_t>;

// The arguments of a function. Their leading axes broadcast to `shape`, as in numpy.
class Arguments {
public:
  Axes shape;
  py::ssize_t rows, count = 1;  // `rows`: rows of a matrix, 3 or 4; `count`: number of maps for each result

  Arguments(const char* function, const py::object& maps, bool several = false) : function_(function) {
    const py::array array = as_array(function, maps);
    single_ = is_single(function, array);
    rows = array.ndim() > 0 && array.shape(array.ndim() - 1) == 3 ? 3 : 4;
    if (several && array.ndim() > 2) count = array.shape(array.ndim() - 3);
    add("maps", array, several ? Axes{count, rows, rows} : Axes{rows, rows});
  }

  // Adds an argument, whose last axes must be `own`. Numbers and vectors must be finite.
  void add(const char* what, const py::object& object, const Axes& own) {
    const auto array = numbers(function_, what, object, own.size() < 2);
    const Axes axes(array.shape(), array.shape() + array.ndim());
    const auto before = axes.end() - static_cast<std::ptrdiff_t>(std::min(axes.size(), own.size()));
    if (!std::equal(before, axes.end(), own.begin(), own.end()))
      wrong(function_, py::str("{} must end in axes {}; this shape is {}").format(what, own, axes));
    shape = with_numpy(function_, [&] {
      return numpy_.attr("broadcast_shapes")(shape, Axes(axes.begin(), before)).cast<Axes>();
    });
    all_.push_back({array, own});
  }

  // Calls f(i) for each result, without the GIL.
  template <class F>
  void each(const F& f) {
    for (auto& [array, own] : all_)
      array = numpy_.attr("broadcast_to")(array, py::cast(shape) + py::cast(own));
    const py::ssize_t size = product(shape);
    const py::gil_scoped_release release;
    for (py::ssize_t i = 0; i < size; ++i) f(i);
  }

  // Returns an array of the maps or logarithms f(i), for all results i.
  template <class F>
  py::array results(const F& f) {
    Contiguous<double> result = numpy_.attr("zeros")(py::cast(shape) + py::cast(Axes{rows, rows}));
    double* to = result.mutable_data();
    each([&](py::ssize_t i) {
      const auto map = f(i);
      for (int r = 0; r < 3; ++r, to += rows) {
        std::copy_n(map.linear.begin() + 3 * r, 3, to);
        if (rows == 4) to[3] = map.translation[r];
      }
      if (rows == 4) {
        to[3] = std::is_same_v<decltype(map), const Affine>;
        to += 4;
      }
    });
    return single_ ? py::array_t<float>(result) : py::array(result);
  }

  // Returns the numbers of an argument for result i.
  const double* at(std::size_t argument, py::ssize_t i) const {
    return all_[argument].array.data() + i * product(all_[argument].own);
  }
  sym3::Vec3<double> vector(std::size_t argument, py::ssize_t i) const {
    const double* v = at(argument, i);
    return {v[0], v[1], v[2]};
  }
  template <class Map = Affine>
  Map map(std::size_t argument, py::ssize_t i, py::ssize_t k = 0) const {
    const double* from = at(argument, i) + k * rows * rows;
    Map map;
    for (int r = 0; r < 3; ++r, from += rows) {
      std::copy_n(from, 3, map.linear.begin() + 3 * r);
      if (rows == 4) map.translation[r] = from[3];
    }
    return map;
  }

  template <class F>
  auto weighted(const F& f, py::ssize_t i) const {
    std::vector<Affine> maps;
    for (py::ssize_t k = 0; k < count; ++k) maps.push_back(map(0, i, k));
    return f(maps, std::span(at(1, i), maps.size()));
  }

private:
  struct Argument {
    Contiguous<double> array;
    Axes own;
  };
  const char* function_;
  bool single_;  // true if results are float32
  py::module_ numpy_ = py::module_::import("numpy");
  std::vector<Argument> all_;

  static py::ssize_t product(const Axes& axes) {
    return std::accumulate(axes.begin(), axes.end(), py::ssize_t{1}, std::multiplies<>());
  }
};

py::array affine_log(const py::object& m, const py::object& near) {
  Arguments all("affine_log", m);
  const bool follows = !near.is_none();
  if (follows) all.add("near", near, {3});
  return all.results([&](auto i) {
    return follows ? sym3::log_affine(all.map(0, i), all.vector(1, i)) : sym3::log_affine(all.map(0, i));
  });
}

py::array affine_exp(const py::object& l) {
  Arguments all("affine_exp", l);
  return all.results([&](auto i) { return sym3::exp_affine(all.map<AffineLog>(0, i)); });
}

py::array affine_has_log(const py::object& m) {
  Arguments all("affine_has_log", m);
  py::array_t<bool> result(all.shape);
  all.each([&, to = result.mutable_data()](auto i) { to[i] = sym3::has_log(all.map(0, i).linear); });
  return result;
}

py::array affine_interpolate(const py::object& a, const py::object& b, const py::object& t,
                             const py::object& near) {
  Arguments all("affine_interpolate", a);
  all.add("b", b, {all.rows, all.rows});
  all.add("t", t, {});
  const bool follows = !near.is_none();
  if (follows) all.add("near", near, {3});
  return all.results([&](auto i) {
    const Affine from = all.map(0, i), to = all.map(1, i);
    const double at = *all.at(2, i);
    return follows ? sym3::interpolate(from, to, at, all.vector(3, i)) : sym3::interpolate(from, to, at);
  });
}

py::array affine_combine(const py::object& maps, const py::object& weights) {
  Arguments all("affine_combine", maps, true);
  all.add("weights", weights, {all.count});
  return all.results([&](auto i) { return all.weighted(sym3::combine, i); });
}

py::tuple affine_mean(const py::object& maps, const py::object& weights) {
  Arguments all("affine_mean", maps, true);
  all.add("weights", shares("affine_mean", weights, all.count), {all.count});
  py::array_t<bool> converged(all.shape);
  const py::array means = all.results([&, flags = converged.mutable_data()](auto i) {
    const sym3::AffineMean mean = all.weighted(sym3::mean, i);
    flags[i] = mean.converged;
    return mean.map;
  });
  return py::make_tuple(means, converged);
}

}  // namespace

void define_affine(py::module_& m) {
  const auto define = [&](const char* name, const auto& f, const char* text, const auto&... arguments) {
    constexpr const char* rules =
        "\n\nMaps are (..., 3, 3), or (..., 4, 4) with the translation in the last column. The last row of "
        "4x4 matrices is not read. float32 or float64; computed in float64. Releases the GIL.";
    m.def(name, f, arguments..., (std::string(text) + rules).c_str());
  };
  const auto near = py::arg("near") = py::none();
  define("affine_log", affine_log,
         "The principal logarithm of each map. If affine_has_log is false, for example for a flat map (a "
         "stretch below 1e-11 of another), a bounded matrix instead.\n"
         "near: (..., 3), rotation vectors. The result is then the logarithm on the branch nearest to them.",
         py::arg("m"), near);
  define("affine_exp", affine_exp, "The exponential of each logarithm, a map.", py::arg("l"));
  define("affine_has_log", affine_has_log, "True if affine_exp(affine_log(m)) equals m.", py::arg("m"));
  define("affine_interpolate", affine_interpolate,
         "Interpolates from a at t = 0 to b at t = 1: a exp(t log(a^-1 b)). t: a number or (...).\n"
         "near: (..., 3), rotation vectors that select the nearest branch of the logarithm.",
         py::arg("a"), py::arg("b"), py::arg("t"), near);
  const auto maps = py::arg("maps"), weights = py::arg("weights");
  define("affine_combine", affine_combine,
         "exp(sum w log A) of maps A with weights w. maps: (..., k, 4, 4). weights: (..., k).", maps,
         weights);
  define("affine_mean", affine_mean,
         "Returns (mean, converged) with the bi-invariant mean of maps A: sum w log(mean^-1 A) = 0. maps: "
         "(..., k, 4, 4). weights: (..., k); None means equal weights.",
         maps, weights = py::none());
}

}  // namespace viete::python
