#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <limits>
#include <vector>

#include "python/meshes.h"

namespace viete::python {

namespace {

std::vector<Points> all_points(const char* what, const py::object& shapes) {
  // Python cannot iterate over a memoryview of several dimensions, but numpy can.
  const bool buffer = py::isinstance<py::buffer>(shapes);
  std::vector<Points> all;
  for (const py::handle shape : buffer ? py::object(as_array(what, shapes)) : shapes)
    all.push_back(points_of(what, py::reinterpret_borrow<py::object>(shape)));
  return all;
}

using Shapes = Guarded<ShapeSpace>;
using Poses = Guarded<PoseSpace>;
using Sessions = Guarded<Session>;

namespace fs = std::filesystem;

template <class Space>
void define_sums(py::class_<Guarded<Space>>& space) {
  space.def(
      "mix",
      [](Guarded<Space>& s, const py::object& weights) {
        const auto numbers = python::numbers("mix", "weights", weights);
        if (numbers.ndim() != 1) wrong("mix", "weights must be (k,); this shape is " + shape_text(numbers));
        const std::vector<double> all(numbers.data(), numbers.data() + numbers.size());
        return array_of(s.with([&](const Space& space) { return space.mix(all); }));
      },
      py::arg("weights"),
      "The weighted sum, (n, 3): [1, 0, ...] gives the first shape or pose, [0, 0, ...] the shape or cage at "
      "rest. Weights are from -1000 to 1000.");
  space.def(
      "between",
      [](Guarded<Space>& s, double at, bool linear) {
        return array_of(s.with([&](const Space& space) { return space.between(at, linear); }));
      },
      py::arg("at"), py::arg("linear") = false,
      "Interpolates in log space, (n, 3): 0 gives the first shape or pose, 1 the second, 0.5 halfway.\n"
      "linear: moves vertices along straight lines instead.");
}

py::tuple pose_by_pins(Shapes& shapes, const std::vector<std::uint32_t>& vertices, const py::object& places,
                       double firmness, double freedom) {
  const Points to = points_of("ShapeSpace.pose", places);
  std::vector<double> weights;
  const Points positions = shapes.with(
      [&](const ShapeSpace& s) { return s.pose(vertices, to, firmness, freedom, &weights, heed_signals); });
  return py::make_tuple(array_of(positions), py::cast(weights));
}

}  // namespace

void define_spaces(py::module_& m) {
  py::class_<Shapes> shapes(m, "ShapeSpace",
                            "Blends shapes of a mesh in log space: halfway to 180 degrees is 90 degrees.");
  shapes.def(
      py::init([](const py::object& vertices, const py::object& faces, const py::object& all, int threads) {
        const Mesh rest = mesh_of("ShapeSpace", vertices, faces);
        const std::vector<Points> places = all_points("ShapeSpace", all);
        const py::gil_scoped_release release;
        return Shapes(ShapeSpace(rest, places, threads, heed_signals));
      }),
      py::arg("vertices"), py::arg("faces"), py::arg("shapes"), py::arg("threads") = 0,
      "vertices (n, 3), faces: the mesh at rest. shapes: arrays (n, 3) in order of motion. Raises Error.");
  define_sums(shapes);
  shapes.def("pose", pose_by_pins, py::arg("vertices"), py::arg("places"),
             py::arg("firmness") = std::numeric_limits<double>::infinity(), py::arg("freedom") = 0.3,
             "Example-based posing: moves some vertices (a list of indices) to places (p, 3); all others "
             "follow blends of the shapes. Returns (positions (n, 3), weights).\n\nfirmness: infinite makes "
             "places exact; 1 is about the stiffness between neighbours; 0.3 is soft. freedom: 0 follows the "
             "shapes, 1 is as rigid as possible. At most 1000 vertices, each once. The time grows at least "
             "with the square of their number. Raises Error.");
  py::class_<Poses> poses(m, "PoseSpace", "Blends poses of a cage in log space.");
  poses.def(py::init([](const py::object& vertices, const py::object& faces, const py::object& all) {
              const Mesh cage = mesh_of("PoseSpace", vertices, faces);
              const std::vector<Points> places = all_points("PoseSpace", all);
              const py::gil_scoped_release release;
              return Poses(PoseSpace(cage, places));
            }),
            py::arg("cage_vertices"), py::arg("cage_faces"), py::arg("poses"),
            "cage_vertices (k, 3), cage_faces: the cage at rest. poses: arrays (k, 3). Raises Error.");
  define_sums(poses);
  py::class_<Sessions>(m, "Session", "A session saved by the viewer, with a model and its animation.")
      .def(py::init([](const fs::path& file) {
             const py::gil_scoped_release release;
             return Sessions(Session(file));
           }),
           py::arg("path"), "Reads a .viete file with its model and cage. Raises Error.")
      .def(
          "frame",
          [](Sessions& s, double frame) {
            return array_of(s.with([&](const Session& session) { return session.frame(frame); }));
          },
          py::arg("frame") = 1.0,
          "The model's vertices (n, 3) at a frame, as `viete animate` writes them. A frame may be fractional "
          "and is clamped to the range. Without keys, the current pose.")
      .def_property_readonly(
          "range", [](Sessions& s) { return s.object.range(); }, "The first and the last frame.")
      .def_property_readonly(
          "vertices", [](Sessions& s) { return array_of(s.object.model().vertices); },
          "Vertices of the model at rest, (n, 3).")
      .def_property_readonly(
          "faces", [](Sessions& s) { return faces_of(s.object.model()); }, "Faces of the model.")
      .def_property_readonly(
          "notes", [](Sessions& s) { return s.object.notes(); },
          "Warnings about the session, one line each.");
}

}  // namespace viete::python
