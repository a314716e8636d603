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

// Some rows or columns are of the same memory, but for views that leave gaps in others.
bool overlaps_itself(const py::array& a) {
  if (a.size() <= 1) return false;
  py::ssize_t steps[] = {std::abs(a.strides(0)), std::abs(a.strides(1))}, counts[] = {a.shape(0), a.shape(1)};
  if (steps[0] < steps[1]) std::swap(steps[0], steps[1]), std::swap(counts[0], counts[1]);
  return (counts[1] > 1 && steps[1] < a.itemsize()) || (counts[0] > 1 && steps[0] < steps[1] * counts[1]);
}

/// Where answers go, of any order and strides: where they do not lie one after the other, a copy is put there
/// at last.
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
        (result_.flags() & direct) == direct && py::isinstance<py::array_t<T>>(out);  // also in order
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
    throw py::type_error("viete.Deformer.deform: " + std::string(what) + " is an array" +
                         (std::string(what) == "normals" ? ", or True or False" : ""));
  const auto array = py::reinterpret_borrow<py::array>(out);
  if (array.dtype().kind() != 'f' || (array.itemsize() != 4 && array.itemsize() != 8))
    throw py::type_error("viete.Deformer.deform: " + std::string(what) + " is float32 or float64");
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
      throw py::type_error("viete.Deformer.deform: normals are of the same type as the places");
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
    throw py::type_error("viete.Deformer: dtype is float32 or float64");
  const py::gil_scoped_release release;
  return std::make_unique<PythonDeformer>(model, cage, blending, threads, type.itemsize() == 4);
}

template <class T>
T taken(const py::dict& from, const char* key, T otherwise) {
  if (!from.contains(key)) return otherwise;
  try {
    return from[key].cast<T>();
  } catch (const py::cast_error&) {
    const char* kind = std::is_same_v<T, std::string> ? "a word"
                       : std::is_same_v<T, double>    ? "a number"
                       : std::is_same_v<T, Point3>    ? "three numbers"
                                                      : "six numbers";
    wrong("Deformer.set_probes", std::string("a probe's ") + key + " is " + kind);
  }
}

Probe probe_of(const py::dict& words) {
  for (const auto& [key, value] : words) {
    const std::string name = py::str(key);
    if (name != "place" && name != "radius" && name != "falloff" && name != "turn" && name != "stretch" &&
        name != "move")
      wrong("Deformer.set_probes", "a probe has place, radius, falloff, turn, stretch and move, not " + name);
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
    if (given.ndim() != 1) wrong("Deformer.set_mask", "a mask is (n,), a share for each vertex");
    const py::array_t<float, py::array::c_style | py::array::forcecast> array(given);
    if (array.size() == 0 && d.deformer().vertex_count() > 0)
      wrong("Deformer.set_mask", "it has no shares; None lets all vertices move");
    shares.assign(array.data(), array.data() + array.size());
  }
  d.change([&](Deformer& deformer) { deformer.set_mask(shares); });
}

void set_shape(PythonDeformer& d, const py::object& shape) {
  if (shape.is_none()) return d.change([](Deformer& deformer) { deformer.set_shape({}); });
  const py::array_t<double> array = rows_of_3("Deformer.set_shape", shape);
  if (array.size() == 0) wrong("Deformer.set_shape", "it has no places; None is the model at rest");
  d.change([from = numbers_of(array)](Deformer& deformer) { deformer.set_shape(from); });
}

}  // namespace

namespace {

std::string init_text() {
  std::string methods;
  for (const sym3::MethodEntry& entry : sym3::methods())
    methods += "\n  '" + std::string(entry.name) + "': " + entry.sentence;
  return "Binds a model to a cage at rest; fractions of a second to some seconds, and Ctrl-C ends it. All is "
         "copied. Raises Error.\n\n"
         "vertices, cage_vertices: (n, 3), 1e-60 to 1e60 across. faces, cage_faces: (m, k), or a list of "
         "lists.\n"
         "way: how the cage moves the model." +
         library::ways_text() +
         "\nweights, blend: in place of what the way has; not all of them go together, and Error "
         "says which do." +
         library::choices_text() +
         "\nradius: where cut-off weights end, 0.001 to 10 sizes of the cage.\n"
         "turn, stretch: how much of rotations and stretches acts, 0 to 2.\n"
         "stitched: triangles follow the maps, and vertices are solved for so often, 1 to 20. pins, hold (0 "
         "to "
         "1): what holds them, by nearness to the cage (in sizes of the cage), and everywhere.\n"
         "method: of the exponential of each vertex." +
         methods +
         "\nthreads: at most so many, to 1024; 0 for all processors. fork() waits for a deform() of another "
         "thread "
         "to end; the child works with one.\n"
         "dtype: of what deform() makes: float64 with the bits of viete deform; or float32 with compressed "
         "weights, three to nine times as fast and off by up to 1e-4 of the diagonal of the cage, at rest or "
         "posed, usually by 1e-5.\n\n"
         "It cannot be copied or pickled.";
}

}  // namespace

void define_deformer(py::module_& m) {
  py::class_<PythonDeformer>(m, "Deformer", "One model bound to one cage.")
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
      .def("deform", &PythonDeformer::deform, py::arg("cage"), py::arg("out") = py::none(),
           py::arg("normals") = py::none(),
           "The model's vertices (n, 3) for the cage's, (k, 3), as they are posed.\n\n"
           "out: where they go, of any strides: float64 or float32, in which they are then computed, "
           "whatever dtype says.\n"
           "normals: an array of the same type for normals, or True; then vertices, normals are returned.\n"
           "Other Python threads run meanwhile; calls of one deformer take turns.")
      .def_readwrite("keeps_turns", &PythonDeformer::keeps_turns,
                     "False at first: each connected part of the cage turns the least. True: as a whole as "
                     "near as can be to the pose before, so that it may turn round and round.")
      .def("forget_turns", &PythonDeformer::forget_turns, "The next pose turns the least.")
      .def("set_mask", set_mask, py::arg("mask"),
           "How much of its motion each vertex makes, (n,), 0 to 1; None: all of it. Binds anew.")
      .def("set_shape", set_shape, py::arg("shape"),
           "What the cage acts upon, (n, 3); None: the model at rest.")
      .def(
          "set_probes",
          [](PythonDeformer& d, const std::vector<py::dict>& all) {
            std::vector<Probe> probes;
            for (const py::dict& words : all) probes.push_back(probe_of(words));
            d.change([&](Deformer& deformer) { deformer.set_probes(probes); });
          },
          py::arg("probes"),
          ("A layer upon the cage, of dictionaries.\n\n"
           "place: at rest, (x, y, z). radius: where it ends; 1.\nturn: a rotation vector. stretch: a "
           "logarithm, "
           "xx xy xz yy yz zz. move: (x, y, z). 0 each.\nfalloff:" +
           library::falloffs_text())
              .c_str())
      .def_property_readonly(
          "notes", [](const PythonDeformer& d) { return d.deformer().notes(); },
          "What a person should know of the cage, one line each: that it is open, flat, ... Whether the "
          "model "
          "is inside is not looked at.");
}

}  // namespace viete::python
