#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "library/words.h"
#include "python/deformation.h"
#include "python/meshes.h"
#include "sym3/exp.h"

namespace viete::python {

namespace {

// True if rows or columns overlap; strided views with gaps do not.
bool overlaps_itself(const py::array& a) {
  if (a.size() <= 1) return false;
  py::ssize_t steps[] = {std::abs(a.strides(0)), std::abs(a.strides(1))}, counts[] = {a.shape(0), a.shape(1)};
  if (steps[0] < steps[1]) std::swap(steps[0], steps[1]), std::swap(counts[0], counts[1]);
  return (counts[1] > 1 && steps[1] < a.itemsize()) || (counts[0] > 1 && steps[0] < steps[1] * counts[1]);
}

/// The result array, of any order and strides. A non-contiguous one is filled by a final copy.
template <class T>
class Out {
public:
  Out(const char* what, const py::object& out, std::size_t vertices)
      : shape_{static_cast<py::ssize_t>(vertices), 3} {
    if (out.is_none()) {
      result_ = work_ = py::array_t<T>(shape_);
      return;
    }
    result_ = py::reinterpret_borrow<py::array>(out);
    if (result_.ndim() != 2 || result_.shape(0) != shape_[0] || result_.shape(1) != 3)
      wrong("Deformer.deform", std::string(what) + " has shape " + shape_text(result_) + " for " +
                                   std::to_string(vertices) + " vertices");
    if (!result_.writeable()) wrong("Deformer.deform", std::string(what) + " is read-only");
    constexpr int direct =
        static_cast<int>(py::array::c_style) | static_cast<int>(py::detail::npy_api::NPY_ARRAY_ALIGNED_);
    if (overlaps_itself(result_)) wrong("Deformer.deform", std::string(what) + " overlaps itself");
    const bool lies =
        (result_.flags() & direct) == direct && py::isinstance<py::array_t<T>>(out);  // also contiguous
    work_ = lies ? py::reinterpret_borrow<py::array_t<T>>(out) : py::array_t<T>(shape_);
  }
  std::span<T> numbers() { return {work_.mutable_data(), static_cast<std::size_t>(work_.size())}; }
  const py::array& array() const { return result_; }
  py::array finish() {
    if (!work_.is(result_)) result_[py::ellipsis()] = work_;
    return result_;
  }

private:
  std::vector<py::ssize_t> shape_;
  py::array result_;
  py::array_t<T> work_;
};

py::array checked_out(const char* what, const py::object& out) {
  if (!py::isinstance<py::array>(out))
    throw py::type_error("viete.Deformer.deform: " + std::string(what) + " must be an array" +
                         (std::string(what) == "normals" ? ", or True or False" : ""));
  const auto array = py::reinterpret_borrow<py::array>(out);
  if (array.dtype().kind() != 'f' || (array.itemsize() != 4 && array.itemsize() != 8))
    throw py::type_error("viete.Deformer.deform: " + std::string(what) + " must be float32 or float64");
  return array;
}

class PythonDeformer {
public:
  PythonDeformer(const Mesh& model, const Mesh& cage, const Blending& blending, int threads, bool single)
      : deformer_(model, cage, blending, threads), single_(single) {
    deformer_.bind(single, heed_signals);
  }

  py::object deform(const py::object& cage, const py::object& out, const py::object& normals) {
    const bool wants_normals =
        !normals.is_none() && !(py::isinstance<py::bool_>(normals) && !normals.cast<bool>());
    const bool own_normals = wants_normals && py::isinstance<py::bool_>(normals);
    bool single = single_;
    if (!out.is_none()) single = checked_out("out", out).itemsize() == 4;
    if (wants_normals && !own_normals && (checked_out("normals", normals).itemsize() == 4) != single)
      throw py::type_error("viete.Deformer.deform: normals must have the same type as out");
    const py::object to = own_normals ? py::none() : normals;
    return single ? deform_as<float>(cage, out, wants_normals, to)
                  : deform_as<double>(cage, out, wants_normals, to);
  }

  template <class T>
  py::object deform_as(const py::object& cage, const py::object& out, bool wants_normals,
                       const py::object& normals) {
    const py::array_t<double> pose = rows_of_3("Deformer.deform", cage);
    Out<T> to("out", out, deformer_.vertex_count());
    std::optional<Out<T>> of_normals;
    if (wants_normals) of_normals.emplace("normals", normals, deformer_.vertex_count());
    if (of_normals && overlap(to.array(), of_normals->array()))
      wrong("Deformer.deform", "out and normals share memory");
    {
      const std::span<const double> from = numbers_of(pose);
      const std::span<T> places = to.numbers(),
                         directions = of_normals ? of_normals->numbers() : std::span<T>();
      std::mutex& mutex = call_lock_.mutex();
      const py::gil_scoped_release release;
      const std::lock_guard lock(mutex);
      deformer_.deform(from, places, directions, keeps_turns ? &turns_ : nullptr);
    }
    if (!of_normals) return to.finish();
    const py::array first = to.finish();
    return py::make_tuple(first, of_normals->finish());
  }

  template <class Act>
  void change(const Act& act) {
    std::mutex& mutex = call_lock_.mutex();
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex);
    act(deformer_);
  }
  const Deformer& deformer() const { return deformer_; }
  void forget_turns() {
    change([this](Deformer&) { turns_.clear(); });
  }

  bool keeps_turns = false;

private:
  Deformer deformer_;
  bool single_;
  Points turns_;
  CallLock call_lock_;
};

}  // namespace

}  // namespace viete::python

namespace pybind11::detail {

template <>
struct type_caster<viete::python::PythonDeformer>
    : viete::python::Initialised<viete::python::PythonDeformer> {};

}  // namespace pybind11::detail

namespace viete::python {

namespace {

std::unique_ptr<PythonDeformer> make_deformer(const py::object& vertices, const py::object& faces,
                                              const py::object& cage_vertices, const py::object& cage_faces,
                                              const Blending& blending, int threads,
                                              const py::object& dtype) {
  const Mesh model = mesh_of("Deformer", vertices, faces),
             cage = mesh_of("Deformer", cage_vertices, cage_faces);
  const auto type = py::dtype::from_args(dtype);
  if (type.kind() != 'f' || (type.itemsize() != 4 && type.itemsize() != 8))
    throw py::type_error("viete.Deformer: dtype must be float32 or float64");
  const py::gil_scoped_release release;
  return std::make_unique<PythonDeformer>(model, cage, blending, threads, type.itemsize() == 4);
}

template <class T>
T taken(const py::dict& from, const char* key, T otherwise) {
  if (!from.contains(key)) return otherwise;
  try {
    return from[key].cast<T>();
  } catch (const py::cast_error&) {
    const char* kind = std::is_same_v<T, std::string> ? "a string"
                       : std::is_same_v<T, double>    ? "a number"
                       : std::is_same_v<T, Point3>    ? "three numbers"
                                                      : "six numbers";
    wrong("Deformer.set_probes", std::string("a probe's ") + key + " must be " + kind);
  }
}

Probe probe_of(const py::dict& words) {
  for (const auto& [key, value] : words) {
    const std::string name = py::str(key);
    if (name != "place" && name != "radius" && name != "falloff" && name != "turn" && name != "stretch" &&
        name != "move")
      wrong("Deformer.set_probes", "probes have place, radius, falloff, turn, stretch and move, not " + name);
  }
  if (!words.contains("place")) wrong("Deformer.set_probes", "a probe needs a place");
  Probe probe;
  probe.place = taken(words, "place", probe.place);
  probe.radius = taken(words, "radius", probe.radius);
  probe.falloff = taken(words, "falloff", probe.falloff);
  probe.turn = taken(words, "turn", probe.turn);
  probe.stretch = taken(words, "stretch", probe.stretch);
  probe.move = taken(words, "move", probe.move);
  return probe;
}

void set_mask(PythonDeformer& d, const py::object& mask) {
  std::vector<float> shares;
  if (!mask.is_none()) {
    const py::array given = as_array("Deformer.set_mask", mask);
    is_single("Deformer.set_mask", given);
    if (given.ndim() != 1) wrong("Deformer.set_mask", "a mask must be (n,), one value per vertex");
    const py::array_t<float, py::array::c_style | py::array::forcecast> array(given);
    if (array.size() == 0 && d.deformer().vertex_count() > 0)
      wrong("Deformer.set_mask", "the mask is empty; None lets all vertices move");
    shares.assign(array.data(), array.data() + array.size());
  }
  d.change([&](Deformer& deformer) { deformer.set_mask(shares); });
}

void set_shape(PythonDeformer& d, const py::object& shape) {
  if (shape.is_none()) return d.change([](Deformer& deformer) { deformer.set_shape({}); });
  const py::array_t<double> array = rows_of_3("Deformer.set_shape", shape);
  if (array.size() == 0) wrong("Deformer.set_shape", "the shape is empty; None restores the rest shape");
  d.change([from = numbers_of(array)](Deformer& deformer) { deformer.set_shape(from); });
}

}  // namespace

namespace {

std::string init_text() {
  std::string methods;
  for (const sym3::MethodEntry& entry : sym3::methods())
    methods += "\n  '" + std::string(entry.name) + "': " + entry.sentence;
  return "Binds a model to a cage at rest, which takes up to some seconds; Ctrl-C cancels. Arguments are "
         "copied. Raises Error.\n\n"
         "vertices, cage_vertices: (n, 3), 1e-60 to 1e60 across. faces, cage_faces: (m, k), or a list of "
         "lists.\n"
         "way: how the cage moves the model." +
         library::ways_text() +
         "\nweights, blend: override those of the way. Not all combinations are valid; Error lists the valid "
         "ones." +
         library::choices_text() +
         "\nradius: reach of cut-off weights in cage sizes, 0.001 to 10.\n"
         "turn, stretch: factors on rotations and stretches, 0 to 2.\n"
         "stitched: number of iterations, 1 to 20, that solve for vertices whose triangles follow the maps. "
         "pins, hold (0 to 1): pin radius around the cage in cage sizes, and weight of every vertex's "
         "blended position.\n"
         "method: how the matrix exponential of each vertex is computed." +
         methods +
         "\nthreads: maximum number, up to 1024; 0: one per processor. fork() waits until deform() calls of "
         "other threads end; the child process uses one thread.\n"
         "dtype: type of deform() results: float64 gives the bits of `viete deform`; float32 uses compressed "
         "weights, three to nine times as fast, with an error of up to 1e-4 of the diagonal of the cage at "
         "rest or posed, usually 1e-5.\n\n"
         "Cannot be copied or pickled.";
}

}  // namespace

void define_deformer(py::module_& m) {
  py::class_<PythonDeformer>(m, "Deformer", "A model bound to a cage.")
      .def(py::init([](const py::object& vertices, const py::object& faces, const py::object& cage_vertices,
                       const py::object& cage_faces, const std::string& way, const std::string& weights,
                       const std::string& blend, std::optional<double> radius, std::optional<double> turn,
                       std::optional<double> stretch, std::optional<int> stitched, std::optional<double> pins,
                       std::optional<double> hold, const std::string& method, int threads,
                       const py::object& dtype) {
             return make_deformer(vertices, faces, cage_vertices, cage_faces,
                                  {way, weights, blend, radius, turn, stretch, stitched, pins, hold, method},
                                  threads, dtype);
           }),
           py::arg("vertices"), py::arg("faces"), py::arg("cage_vertices"), py::arg("cage_faces"),
           py::arg("way") = "smooth", py::kw_only(), py::arg("weights") = "", py::arg("blend") = "",
           py::arg("radius") = py::none(), py::arg("turn") = py::none(), py::arg("stretch") = py::none(),
           py::arg("stitched") = py::none(), py::arg("pins") = py::none(), py::arg("hold") = py::none(),
           py::arg("method") = "fast", py::arg("threads") = 0, py::arg("dtype") = "float64",
           init_text().c_str())
      .def(
          "deform", &PythonDeformer::deform, py::arg("cage"), py::arg("out") = py::none(),
          py::arg("normals") = py::none(),
          "The model's vertices (n, 3) for a pose of the cage's vertices, (k, 3).\n\n"
          "out: an array for the result, with any strides: float64 or float32, which sets the precision, "
          "regardless of dtype.\n"
          "normals: an array of the same type for normals, or True; the result is then (vertices, normals).\n"
          "Releases the GIL; calls of one deformer run one after another.")
      .def_readwrite("keeps_turns", &PythonDeformer::keeps_turns,
                     "False (default): each connected part of the cage takes the shortest rotation. True: "
                     "takes the rotation nearest to the previous pose, so that full rotations add up.")
      .def("forget_turns", &PythonDeformer::forget_turns, "The next pose takes the shortest rotations.")
      .def("set_mask", set_mask, py::arg("mask"),
           "Scales the motion of each vertex, (n,), 0 to 1; None: no scaling. Binds again.")
      .def("set_shape", set_shape, py::arg("shape"),
           "The shape that the cage deforms, (n, 3); None: the model at rest.")
      .def(
          "set_probes",
          [](PythonDeformer& d, const std::vector<py::dict>& all) {
            std::vector<Probe> probes;
            for (const py::dict& words : all) probes.push_back(probe_of(words));
            d.change([&](Deformer& deformer) { deformer.set_probes(probes); });
          },
          py::arg("probes"),
          ("Sets probes, which act after the cage: a list of dictionaries.\n\n"
           "place: rest position, (x, y, z). radius: reach, default 1.\nturn: a rotation vector. stretch: "
           "the logarithm, xx xy xz yy yz zz. move: (x, y, z). 0 each.\nfalloff:" +
           library::falloffs_text())
              .c_str())
      .def_property_readonly(
          "notes", [](const PythonDeformer& d) { return d.deformer().notes(); },
          "Warnings about the cage, one line each: that it is open, flat, ... They do not cover whether the "
          "model is inside.");
}

}  // namespace viete::python
