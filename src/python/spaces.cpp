#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <vector>

#include "python/deformation.h"
#include "python/meshes.h"

namespace viete::python {

namespace {

std::vector<Points> all_points(const char* what, const py::object& shapes) {
  std::vector<Points> all;
  for (const py::handle shape : shapes)
    all.push_back(points_of(what, py::reinterpret_borrow<py::object>(shape)));
  return all;
}

/// One thread after the other, the interpreter being free meanwhile.
template <class Space>
struct Guarded {
  Space space;
  mutable CallLock call_lock{};

  template <class Act>
  auto with(const Act& act) const {
    std::mutex& mutex = call_lock.mutex();
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex);
    return act(space);
  }
};
using Shapes = Guarded<ShapeSpace>;
using Poses = Guarded<PoseSpace>;
using Sessions = Guarded<Session>;

}  // namespace

}  // namespace viete::python

namespace pybind11::detail {

template <>
struct type_caster<viete::python::Shapes> : viete::python::Initialised<viete::python::Shapes> {};
template <>
struct type_caster<viete::python::Poses> : viete::python::Initialised<viete::python::Poses> {};
template <>
struct type_caster<viete::python::Sessions> : viete::python::Initialised<viete::python::Sessions> {};

}  // namespace pybind11::detail

namespace viete::python {

namespace {

namespace fs = std::filesystem;

template <class Space>
void define_sums(py::class_<Guarded<Space>>& space) {
  space.def(
      "vector",
      [](const Guarded<Space>& s, std::size_t number) {
        const auto logs = s.with([&](const Space& space) { return space.vector(number); });
        py::array_t<double> array({static_cast<py::ssize_t>(logs.size()), py::ssize_t{9}});
        for (std::size_t t = 0; t < logs.size(); ++t)
          std::copy_n(logs[t].begin(), 9, array.mutable_data() + 9 * t);
        return array;
      },
      py::arg("number"),
      "Of the one of that number, from 0: the log of each triangle's map, (t, 9): stretch xx xy xz yy yz zz, "
      "rotation vector.");
  space.def(
      "mix",
      [](const Guarded<Space>& s, const std::vector<double>& weights) {
        return array_of(s.with([&](const Space& space) { return space.mix(weights); }));
      },
      py::arg("weights"),
      "The sum of all, each times its weight, (n, 3): 0 is rest, [1, 0, ...] the first one; up to 1000 in "
      "size.");
  space.def(
      "between",
      [](const Guarded<Space>& s, double at, bool straight) {
        return array_of(s.with([&](const Space& space) { return space.between(at, straight); }));
      },
      py::arg("at"), py::arg("straight") = false,
      "On the way through all of them, (n, 3): 0 is the first one, 1 the second, 0.5 halfway in log space; "
      "straight: "
      "each vertex on its straight line.");
}

py::tuple pose_by_pins(const Shapes& shapes, const std::vector<std::uint32_t>& vertices,
                       const py::object& places, double firmness, double freedom) {
  const Points to = points_of("ShapeSpace.pose", places);
  std::vector<double> weights;
  const Points positions = shapes.with(
      [&](const ShapeSpace& s) { return s.pose(vertices, to, firmness, freedom, &weights, heed_signals); });
  return py::make_tuple(array_of(positions), py::cast(weights));
}

}  // namespace

void define_spaces(py::module_& m) {
  py::class_<Shapes> shapes(m, "ShapeSpace",
                            "Shapes of one mesh in log space: halfway to a half turn is a quarter turn.");
  shapes.def(
      py::init([](const py::object& vertices, const py::object& faces, const py::object& all, int threads) {
        const Mesh rest = mesh_of("ShapeSpace", vertices, faces);
        const std::vector<Points> places = all_points("ShapeSpace", all);
        const py::gil_scoped_release release;
        return Shapes{ShapeSpace(rest, places, threads, heed_signals)};
      }),
      py::arg("vertices"), py::arg("faces"), py::arg("shapes"), py::arg("threads") = 0,
      "vertices (n, 3) and faces at rest; shapes: (n, 3) each, in the order of a motion. Raises Error.");
  define_sums(shapes);
  shapes.def("pose", pose_by_pins, py::arg("vertices"), py::arg("places"),
             py::arg("firmness") = std::numeric_limits<double>::infinity(), py::arg("freedom") = 0.3,
             "positions (n, 3), weights: the shape among mixes, and near them, that has these vertices "
             "(their numbers) at these places "
             "(p, 3).\n\nfirmness: infinite holds them, 0.3 pulls about as strongly as neighbours do. "
             "freedom: 0 as the shapes say, 1 as rigid as can be. At most 1000 vertices, each once: the "
             "time goes with their square and more. Raises Error.");
  py::class_<Poses> poses(m, "PoseSpace", "Poses of a cage in log space.");
  poses.def(py::init([](const py::object& vertices, const py::object& faces, const py::object& all) {
              const Mesh cage = mesh_of("PoseSpace", vertices, faces);
              const std::vector<Points> places = all_points("PoseSpace", all);
              const py::gil_scoped_release release;
              return Poses{PoseSpace(cage, places)};
            }),
            py::arg("cage_vertices"), py::arg("cage_faces"), py::arg("poses"),
            "The cage at rest, and poses of it, (k, 3) each. Raises Error.");
  define_sums(poses);
}

void define_session(py::module_& m) {
  py::class_<Sessions>(
      m, "Session", "A session of the viewer: its model as it is posed, and at the frames of its timeline.")
      .def(py::init([](const fs::path& file) {
             const py::gil_scoped_release release;
             return Sessions{Session(file)};
           }),
           py::arg("path"), "Reads a .viete file, its model and its cage. Raises Error.")
      .def(
          "frame",
          [](const Sessions& s, double frame) {
            return array_of(s.with([&](const Session& session) { return session.frame(frame); }));
          },
          py::arg("frame") = 1.0,
          "The model's vertices (n, 3) at that frame, which may lie between two, as viete animate writes "
          "them; "
          "beyond the range as its ends have it; without keys as it is posed.")
      .def_property_readonly(
          "range", [](const Sessions& s) { return s.space.range(); }, "The first and the last frame.")
      .def_property_readonly(
          "vertices", [](const Sessions& s) { return array_of(s.space.model().vertices); },
          "Of the model at rest, (n, 3).")
      .def_property_readonly(
          "faces",
          [](const Sessions& s) {
            const Mesh model = s.space.model();
            return faces_of(model.corners, model.starts);
          },
          "Of the model.")
      .def_property_readonly(
          "cage_vertices", [](const Sessions& s) { return array_of(s.space.cage().vertices); },
          "Of the cage at rest, (k, 3).")
      .def_property_readonly(
          "cage_faces",
          [](const Sessions& s) {
            const Mesh cage = s.space.cage();
            return faces_of(cage.corners, cage.starts);
          },
          "Of the cage.")
      .def_property_readonly(
          "pose", [](const Sessions& s) { return array_of(s.space.pose()); }, "Of the cage, (k, 3).")
      .def_property_readonly(
          "notes", [](const Sessions& s) { return s.space.notes(); }, "What a person should know of it.");
}

}  // namespace viete::python
