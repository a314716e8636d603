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

/// A space whose calls run one after another, without the GIL.
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
      "The log of each triangle's map in shape or pose `number`, from 0, (t, 9): stretch xx xy xz yy yz zz, "
      "rotation vector.");
  space.def(
      "mix",
      [](const Guarded<Space>& s, const std::vector<double>& weights) {
        return array_of(s.with([&](const Space& space) { return space.mix(weights); }));
      },
      py::arg("weights"),
      "The weighted sum, (n, 3): all 0 is rest, [1, 0, ...] the first one; weights up to 1000 in size.");
  space.def(
      "between",
      [](const Guarded<Space>& s, double at, bool straight) {
        return array_of(s.with([&](const Space& space) { return space.between(at, straight); }));
      },
      py::arg("at"), py::arg("straight") = false,
      "Interpolates the sequence, (n, 3): 0 is the first one, 1 the second, 0.5 halfway in log space; "
      "straight: moves vertices along straight lines.");
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
                            "Shapes of one mesh in log space: half of a 180 degree rotation is 90 degrees.");
  shapes.def(
      py::init([](const py::object& vertices, const py::object& faces, const py::object& all, int threads) {
        const Mesh rest = mesh_of("ShapeSpace", vertices, faces);
        const std::vector<Points> places = all_points("ShapeSpace", all);
        const py::gil_scoped_release release;
        return Shapes{ShapeSpace(rest, places, threads, heed_signals)};
      }),
      py::arg("vertices"), py::arg("faces"), py::arg("shapes"), py::arg("threads") = 0,
      "vertices (n, 3), faces: the rest mesh. shapes: (n, 3) each, in order of motion. Raises Error.");
  define_sums(shapes);
  shapes.def("pose", pose_by_pins, py::arg("vertices"), py::arg("places"),
             py::arg("firmness") = std::numeric_limits<double>::infinity(), py::arg("freedom") = 0.3,
             "Example-based posing: the shape near the blends that has these vertices (by index) at these "
             "places (p, 3). Returns (positions (n, 3), weights).\n\nfirmness: infinite makes places exact, "
             "0.3 pulls about as strongly as neighbouring vertices do. freedom: 0 follows the shapes, 1 is "
             "as rigid as possible. At most 1000 vertices, each once; the time grows at least with the "
             "square of their number. Raises Error.");
  py::class_<Poses> poses(m, "PoseSpace", "Poses of a cage in log space.");
  poses.def(py::init([](const py::object& vertices, const py::object& faces, const py::object& all) {
              const Mesh cage = mesh_of("PoseSpace", vertices, faces);
              const std::vector<Points> places = all_points("PoseSpace", all);
              const py::gil_scoped_release release;
              return Poses{PoseSpace(cage, places)};
            }),
            py::arg("cage_vertices"), py::arg("cage_faces"), py::arg("poses"),
            "The rest cage and its poses, (k, 3) each. Raises Error.");
  define_sums(poses);
}

void define_session(py::module_& m) {
  py::class_<Sessions>(m, "Session",
                       "A session of the viewer: the posed model, and the model at frames of its timeline.")
      .def(py::init([](const fs::path& file) {
             const py::gil_scoped_release release;
             return Sessions{Session(file)};
           }),
           py::arg("path"), "Reads a .viete file with its model and cage. Raises Error.")
      .def(
          "frame",
          [](const Sessions& s, double frame) {
            return array_of(s.with([&](const Session& session) { return session.frame(frame); }));
          },
          py::arg("frame") = 1.0,
          "The model's vertices (n, 3) at a frame, which may be fractional, as `viete animate` writes them; "
          "clamped to the range; without keys the current pose.")
      .def_property_readonly(
          "range", [](const Sessions& s) { return s.space.range(); }, "The first and the last frame.")
      .def_property_readonly(
          "vertices", [](const Sessions& s) { return array_of(s.space.model().vertices); },
          "Vertices of the rest model, (n, 3).")
      .def_property_readonly(
          "faces",
          [](const Sessions& s) {
            const Mesh model = s.space.model();
            return faces_of(model.corners, model.starts);
          },
          "Faces of the model.")
      .def_property_readonly(
          "cage_vertices", [](const Sessions& s) { return array_of(s.space.cage().vertices); },
          "Vertices of the rest cage, (k, 3).")
      .def_property_readonly(
          "cage_faces",
          [](const Sessions& s) {
            const Mesh cage = s.space.cage();
            return faces_of(cage.corners, cage.starts);
          },
          "Faces of the cage.")
      .def_property_readonly(
          "pose", [](const Sessions& s) { return array_of(s.space.pose()); },
          "The cage's posed vertices, (k, 3).")
      .def_property_readonly(
          "notes", [](const Sessions& s) { return s.space.notes(); },
          "Warnings about the session, one line each.");
}

}  // namespace viete::python
