#include <pybind11/stl.h>

#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "library/arguments.h"
#include "python/meshes.h"

namespace viete::python {

namespace {

struct BoundModel {
  Deformer deformer;
  bool single;  // true if results are float32
  bool keeps_turns = false;
  Points turns{};
};
using Bound = Guarded<BoundModel>;
using Number = std::optional<double>;

Bound bound(const py::object& vertices, const py::object& faces, const py::object& cage_vertices,
            const py::object& cage_faces, const std::string& name, const std::string& weights,
            const std::string& blend, Number radius, Number rotation, Number stretch, bool arap,
            std::optional<int> iterations, Number attach, Number hold, const std::string& method, int threads,
            const py::object& dtype) {
  const Mesh model = mesh_of("Deformer", vertices, faces),
             cage = mesh_of("Deformer", cage_vertices, cage_faces);
  const auto type = py::dtype::from_args(dtype);
  if (type.kind() != 'f' || (type.itemsize() != 4 && type.itemsize() != 8))
    throw py::type_error("viete.Deformer: dtype must be float32 or float64");
  const bool single = type.itemsize() == 4;
  const py::gil_scoped_release release;
  const Blending blending{name, weights,    blend,  radius, rotation, stretch,
                          arap, iterations, attach, hold,   method};
  Deformer deformer(model, cage, blending, threads);
  deformer.bind(single, heed_signals);
  return Bound({std::move(deformer), single});
}

py::object deform(Bound& bound, const py::object& cage, const py::object& out, const py::object& normals) {
  constexpr const char* name = "Deformer.deform";
  const Contiguous<double> pose = rows_of_3(name, cage);
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(bound.object.deformer.vertex_count()), 3};
  const bool single = out.is_none() ? bound.object.single : is_single(name, as_array(name, out));
  return by_type(single, [&]<class T>(T) -> py::object {
    py::array_t<T> places = output<T>(name, "out", out, shape), directions;
    const bool wants_normals = !normals.is_none() && !normals.is(py::bool_(false));
    if (wants_normals)
      directions = output<T>(name, "normals", normals.is(py::bool_(true)) ? py::none() : normals, shape);
    if (overlap(places, directions)) wrong(name, "out and normals share memory");
    const std::span<T> to(places.mutable_data(), static_cast<std::size_t>(places.size())),
        along(directions.mutable_data(), static_cast<std::size_t>(directions.size()));
    bound.with([&, from = numbers_of(pose)](BoundModel& b) {
      b.deformer.deform(from, to, along, b.keeps_turns ? &b.turns : nullptr);
    });
    return wants_normals ? py::object(py::make_tuple(places, directions)) : places;
  });
}

void set_mask(Bound& bound, const py::object& mask) {
  std::vector<float> shares;
  if (!mask.is_none()) {
    const auto array = numbers("Deformer.set_mask", "mask", mask, false);
    if (array.ndim() != 1) wrong("Deformer.set_mask", "a mask must be (n,), one value for each vertex");
    if (array.size() == 0 && bound.object.deformer.vertex_count() > 0)
      wrong("Deformer.set_mask", "the mask is empty; pass None to move all vertices fully");
    shares.assign(array.data(), array.data() + array.size());
  }
  bound.with([&](BoundModel& b) { b.deformer.set_mask(shares); });
}

void set_shape(Bound& bound, const py::object& shape) {
  if (shape.is_none()) return bound.with([](BoundModel& b) { b.deformer.set_shape({}); });
  const Contiguous<double> array = rows_of_3("Deformer.set_shape", shape);
  if (array.size() == 0) wrong("Deformer.set_shape", "the shape is empty; pass None for the rest shape");
  bound.with([from = numbers_of(array)](BoundModel& b) { b.deformer.set_shape(from); });
}

void define_deformer(py::module_& m) {
  const std::string text =
      "Binds a model to a cage at rest, which takes up to some seconds; Ctrl-C cancels. Arguments are "
      "copied. Raises Error. Deformers cannot be copied or pickled.\n\n"
      "vertices, cage_vertices: (n, 3), with a size of 1e-60 to 1e60. faces, cage_faces: (m, k), or a list "
      "of lists." +
      library::settings_text() +
      "\nthreads: largest number of threads, up to 1024; 0 means one for each processor. fork() waits until "
      "deform() calls of other threads end; the child process uses one thread.\n"
      "dtype: type of the results of deform(). float64 gives the same bits as `viete deform`. float32 is "
      "three to nine times as fast, with an error of up to 1e-4 (usually 1e-5) of the diagonal of the cage "
      "at rest or posed.";
  const auto none = py::none();
  py::class_<Bound>(m, "Deformer", "A model bound to a cage.")
      .def(py::init(&bound), py::arg("vertices"), py::arg("faces"), py::arg("cage_vertices"),
           py::arg("cage_faces"), py::arg("deformer") = "smooth", py::kw_only(), py::arg("weights") = "",
           py::arg("blend") = "", py::arg("radius") = none, py::arg("rotation") = none,
           py::arg("stretch") = none, py::arg("arap") = false, py::arg("iterations") = none,
           py::arg("attach") = none, py::arg("hold") = none, py::arg("method") = "fast",
           py::arg("threads") = 0, py::arg("dtype") = "float64", text.c_str())
      .def(
          "deform", deform, py::arg("cage"), py::arg("out") = none, py::arg("normals") = none,
          "The model's vertices (n, 3) for a pose of the cage's vertices (k, 3).\n\n"
          "out: a contiguous array for the result. Its type, float64 or float32, is used instead of dtype.\n"
          "normals: an array of the same type for normals, or True. The result is then (vertices, normals).\n"
          "Releases the GIL. A deformer runs one call at a time.")
      .def_property(
          "keeps_turns", [](const Bound& b) { return b.object.keeps_turns; },
          [](Bound& b, bool keeps) { b.object.keeps_turns = keeps; },
          "If False (default), each connected part of the cage uses the shortest rotation. If True, it uses "
          "the rotation nearest to the previous pose, so that full turns add up.")
      .def(
          "forget_turns", [](Bound& bound) { bound.with([](BoundModel& b) { b.turns.clear(); }); },
          "Lets the next pose use the shortest rotations.")
      .def("set_mask", set_mask, py::arg("mask"),
           "Multiplies the motion of each vertex by a number, (n,), 0 to 1. None: no scaling. Binds again.")
      .def("set_shape", set_shape, py::arg("shape"),
           "Sets the shape that the cage deforms, (n, 3). None means the model at rest.")
      .def_property_readonly(
          "notes", [](const Bound& b) { return b.object.deformer.notes(); },
          "Warnings about the cage, one line each, for example that it is open or flat. They do not say "
          "whether the model is inside the cage.");
}

}  // namespace

void define_deformation(py::module_& m) {
  static PyObject* const error = m.attr("Error").ptr();
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const base::Error& e) {
      const std::string sentence = e.what();  // may contain file names that are not UTF-8
      const auto text = py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
          sentence.data(), static_cast<py::ssize_t>(sentence.size()), "surrogateescape"));
      if (text) PyErr_SetObject(error, text.ptr());
    }
  });
  define_files(m);
  define_deformer(m);
  define_spaces(m);
  define_splats(m);
}

}  // namespace viete::python
