#include "python/affine.h"

#include <pybind11/stl.h>

#include <string>
#include <type_traits>
#include <vector>

#include "python/matrices.h"
#include "sym3/affine.h"
#include "sym3/general.h"

namespace viete::python {

namespace {

using sym3::Affine, sym3::AffineLog;
using Numbers = Contiguous<double>;
using Axes = std::vector<py::ssize_t>;

// An argument converted to double, split into leading axes and its own last axes.
struct Argument {
  Numbers numbers;
  bool single;  // float32
  Axes before;

  Argument(const char* function, const py::object& object, py::ssize_t own_axes) {
    const py::array array = as_array(function, object);
    single = is_single(function, array);
    numbers = Numbers(array);
    if (numbers.ndim() < own_axes) wrong(function, "too few axes; this shape is " + shape_text(numbers));
    before.assign(numbers.shape(), numbers.shape() + numbers.ndim() - own_axes);
  }

  Axes own() const { return {numbers.shape() + before.size(), numbers.shape() + numbers.ndim()}; }
};

// An argument whose last two axes are 3, 3 or 4, 4.
struct Maps : Argument {
  py::ssize_t rows;

  Maps(const char* function, const py::object& object, py::ssize_t own_axes = 2)
      : Argument(function, object, own_axes) {
    const Axes last = own();
    rows = last.back();
    if (last[own_axes - 2] != rows || (rows != 3 && rows != 4)) {
      wrong(function, "maps are (..., 3, 3) or (..., 4, 4); this shape is " + shape_text(numbers));
    }
  }
};

std::size_t product_of(const Axes& axes) {
  std::size_t count = 1;
  for (const auto n : axes) count *= static_cast<std::size_t>(n);
  return count;
}

Axes joined(Axes a, const Axes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

py::object numpy(const char* name) {
  return py::module_::import("numpy").attr(name);
}

Axes common(const Axes& a, const Axes& b) {
  return py::cast<Axes>(numpy("broadcast_shapes")(py::tuple(py::cast(a)), py::tuple(py::cast(b))));
}

// Broadcasts to these leading axes by repetition.
Numbers spread(const Argument& a, const Axes& before) {
  return Numbers(numpy("broadcast_to")(a.numbers, py::tuple(py::cast(joined(before, a.own())))));
}

template <class Map>
Map read(const double* from, py::ssize_t rows) {
  Map map;
  map.translation = {};
  for (py::ssize_t r = 0; r < 3; ++r) {
    for (py::ssize_t c = 0; c < 3; ++c) map.linear[3 * r + c] = from[rows * r + c];
    if (rows == 4) map.translation[r] = from[4 * r + 3];
  }
  return map;
}

template <class Map>
void write(const Map& map, double* to, py::ssize_t rows) {
  for (py::ssize_t r = 0; r < 3; ++r) {
    for (py::ssize_t c = 0; c < 3; ++c) to[rows * r + c] = map.linear[3 * r + c];
    if (rows == 4) to[4 * r + 3] = map.translation[r], to[12 + r] = 0;
  }
  if (rows == 4) to[15] = std::is_same_v<Map, Affine> ? 1 : 0;
}

sym3::Vec3<double> vector_at(const Numbers& vectors, std::size_t i) {
  const double* v = vectors.data() + 3 * i;
  return {v[0], v[1], v[2]};
}

// An array of matrices (maps or logarithms), the i-th made by make(i); releases the GIL.
template <class Make>
py::array made(const Axes& before, py::ssize_t rows, bool single, const Make& make) {
  Numbers result(joined(before, {rows, rows}));
  double* to = result.mutable_data();
  {
    const py::gil_scoped_release release;
    for (std::size_t i = 0; i < product_of(before); ++i) write(make(i), to + i * rows * rows, rows);
  }
  return single ? py::array_t<float>(result) : py::array(result);
}

// Applies f to every map.
template <class Map, class F>
py::array of_each(const Maps& a, const Axes& before, const F& f) {
  const Numbers numbers = spread(a, before);
  const double* from = numbers.data();
  return made(before, a.rows, a.single,
              [&](std::size_t i) { return f(read<Map>(from + i * a.rows * a.rows, a.rows), i); });
}

// Rotation vectors, one per map: the last axis is 3.
Argument vectors_of(const char* function, const py::object& near) {
  finite_numbers(function, "near", near);
  Argument vectors(function, near, 1);
  if (vectors.own()[0] != 3) {
    wrong(function, "near is (..., 3), rotation vectors; this shape is " + shape_text(vectors.numbers));
  }
  return vectors;
}

py::array affine_log(const py::object& m, const py::object& near) {
  const Maps maps("affine_log", m);
  if (near.is_none()) {
    return of_each<Affine>(maps, maps.before,
                           [](const Affine& a, std::size_t) { return sym3::log_affine(a); });
  }
  const Argument vectors = vectors_of("affine_log", near);
  const Axes before = common(maps.before, vectors.before);
  const Numbers turns = spread(vectors, before);
  return of_each<Affine>(
      maps, before, [&](const Affine& a, std::size_t i) { return sym3::log_affine(a, vector_at(turns, i)); });
}

py::array affine_exp(const py::object& l) {
  const Maps logs("affine_exp", l);
  return of_each<AffineLog>(logs, logs.before,
                            [](const AffineLog& log, std::size_t) { return sym3::exp_affine(log); });
}

py::array affine_has_log(const py::object& m) {
  const Maps maps("affine_has_log", m);
  py::array_t<bool> result(maps.before);
  bool* to = result.mutable_data();
  const py::gil_scoped_release release;
  for (std::size_t i = 0; i < product_of(maps.before); ++i) {
    const Affine map = read<Affine>(maps.numbers.data() + i * maps.rows * maps.rows, maps.rows);
    to[i] = sym3::has_log(map.linear);
  }
  return result;
}

py::array affine_interpolate(const py::object& a, const py::object& b, const py::object& t,
                             const py::object& near) {
  constexpr const char* name = "affine_interpolate";
  const Maps from(name, a), to(name, b);
  if (from.rows != to.rows) wrong(name, "a and b are not of the same size");
  const Argument steps(name, t, 0);
  Axes before = common(common(from.before, to.before), steps.before);
  const bool has_near = !near.is_none();
  const Argument vectors = vectors_of(name, has_near ? near : py::cast(std::vector<double>(3)));
  before = common(before, vectors.before);
  const Numbers other = spread(to, before), at = spread(steps, before), turns = spread(vectors, before);
  const double *targets = other.data(), *ts = at.data();
  return of_each<Affine>(from, before, [&](const Affine& start, std::size_t i) {
    const Affine end = read<Affine>(targets + i * to.rows * to.rows, to.rows);
    return has_near ? sym3::interpolate(start, end, ts[i], vector_at(turns, i))
                    : sym3::interpolate(start, end, ts[i]);
  });
}

// Maps along the third last axis, with a weight each.
struct Weighted {
  Maps maps;
  std::size_t count;
  Axes before;
  Numbers numbers, weights;

  Weighted(const char* function, const py::object& m, const py::object& w) : maps(function, m, 3) {
    const Axes own = maps.own();
    count = static_cast<std::size_t>(own[0]);
    if (count == 0) wrong(function, "there are no maps");
    const Argument given(
        function, w.is_none() ? numpy("ones")(count) : py::object(finite_numbers(function, "weights", w)), 1);
    if (given.own()[0] != own[0]) {
      wrong(function,
            "there are " + std::to_string(count) + " maps; weights have shape " + shape_text(given.numbers));
    }
    before = common(maps.before, given.before);
    numbers = spread(maps, before), weights = spread(given, before);
  }

  std::vector<Affine> at(std::size_t i) const {
    const std::size_t size = static_cast<std::size_t>(maps.rows * maps.rows);
    std::vector<Affine> all;
    for (std::size_t k = 0; k < count; ++k)
      all.push_back(read<Affine>(numbers.data() + (i * count + k) * size, maps.rows));
    return all;
  }
  std::span<const double> weights_at(std::size_t i) const { return {weights.data() + i * count, count}; }
};

py::array affine_combine(const py::object& m, const py::object& w) {
  const Weighted all("affine_combine", m, w);
  return made(all.before, all.maps.rows, all.maps.single,
              [&](std::size_t i) { return sym3::combine(all.at(i), all.weights_at(i)); });
}

py::tuple affine_mean(const py::object& m, const py::object& w) {
  const Weighted all("affine_mean", m, w.is_none() ? w : shares("affine_mean", w));
  py::array_t<bool> converged(all.before);
  bool* ends = converged.mutable_data();
  const py::array means = made(all.before, all.maps.rows, all.maps.single, [&](std::size_t i) {
    const sym3::AffineMean mean = sym3::mean(all.at(i), all.weights_at(i));
    ends[i] = mean.converged;
    return mean.map;
  });
  return py::make_tuple(means, converged);
}

constexpr const char* maps_text =
    "\n\nMaps are (..., 3, 3), or (..., 4, 4) with the translation in the last column; their last row is not "
    "read. float32 or float64; computed in double. Releases the GIL.";

std::string about(const char* text) {
  return std::string(text) + maps_text;
}

}  // namespace

void define_affine(py::module_& m) {
  m.def(
      "affine_log", affine_log, py::arg("m"), py::arg("near") = py::none(),
      about(
          "The principal logarithm of each map, or a bounded substitute if it has none: see affine_has_log.\n"
          "A flat map (a stretch below 1e-11 of another) counts as having none.\n"
          "near: (..., 3), rotation vectors that select the nearest branch of the logarithm, bounded.")
          .c_str());
  m.def("affine_exp", affine_exp, py::arg("l"), about("The map of each logarithm.").c_str());
  m.def("affine_has_log", affine_has_log, py::arg("m"),
        about("True if affine_exp(affine_log(m)) equals m.").c_str());
  m.def("affine_combine", affine_combine, py::arg("maps"), py::arg("weights"),
        about("exp(sum w log A): maps (..., k, 3, 3) or (..., k, 4, 4), weights (..., k).").c_str());
  m.def("affine_interpolate", affine_interpolate, py::arg("a"), py::arg("b"), py::arg("t"),
        py::arg("near") = py::none(),
        about("Interpolates from a at t = 0 to b at t = 1: a exp(t log(a^-1 b)). t: a number or "
              "(...).\nnear: (..., 3), the branch of that logarithm.")
            .c_str());
  m.def("affine_mean", affine_mean, py::arg("maps"), py::arg("weights") = py::none(),
        about("Returns (mean, converged): mean solves sum w log(mean^-1 A) = 0. maps: (..., k, 3, 3) or "
              "(..., k, 4, 4); weights: (..., k), default equal.")
            .c_str());
}

}  // namespace viete::python
