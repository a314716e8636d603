#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <vector>

#include "python/meshes.h"

namespace viete::python {

namespace {

namespace fs = std::filesystem;

struct FileMesh {
  Mesh mesh;
  std::vector<std::string> notes;
};
using Surface = Guarded<FileMesh>;

Surface read(const fs::path& file) {
  const py::gil_scoped_release release;
  FileMesh read;
  read.mesh = read_mesh(file, &read.notes);
  return Surface(std::move(read));
}

std::vector<std::string> write(const fs::path& file, const py::object& surface, const py::object& faces,
                               const py::object& vertices) {
  Mesh mesh;
  if (!py::isinstance<Surface>(surface)) {
    if (faces.is_none()) wrong("write", "faces are required with an array of vertices");
    if (!vertices.is_none()) wrong("write", "vertices= requires a surface from read()");
    mesh = mesh_of("write", surface, faces);
  } else {
    if (!faces.is_none()) wrong("write", "a surface already has faces; omit faces");
    mesh = surface.cast<const Surface&>().object.mesh;
    const std::size_t count = mesh.vertices.size();
    if (!vertices.is_none()) mesh.vertices = points_of("write", vertices);
    if (mesh.vertices.size() != count) wrong("write", "vertices must have a row for each vertex");
  }
  std::vector<std::string> notes;
  const py::gil_scoped_release release;
  write_mesh(file, mesh, &notes);
  return notes;
}

py::tuple make(const py::object& vertices, const py::object& faces, std::int64_t triangles,
               const std::string& kind, double margin, double gap, const std::string& symmetry, bool quads,
               const std::array<std::size_t, 3>& cells, bool own_axes) {
  const Mesh model = mesh_of("make_cage", vertices, faces);
  if (triangles < 0) wrong("make_cage", "triangles must be 12 to 20000");
  const CageWish wish{kind,    static_cast<std::size_t>(triangles), margin, gap, symmetry, quads, cells,
                      own_axes};
  Mesh cage;
  {
    const py::gil_scoped_release release;
    cage = make_cage(model, wish, heed_signals);
  }
  return py::make_tuple(array_of(cage.vertices), faces_of(cage));
}

}  // namespace

void define_files(py::module_& m) {
  py::class_<Surface>(m, "Surface",
                      "A mesh from read(). Its arrays are copies. write() writes all content of the file, "
                      "for example materials.")
      .def_property_readonly(
          "vertices", [](const Surface& s) { return array_of(s.object.mesh.vertices); },
          "Vertex positions, (n, 3) float64.")
      .def_property_readonly(
          "faces", [](const Surface& s) { return faces_of(s.object.mesh); },
          "Vertex indices, (m, k) int32 if all faces have k corners, otherwise a list of arrays.")
      .def_property_readonly(
          "notes", [](const Surface& s) { return s.object.notes; },
          "Warnings about the file, one line each.");
  m.def("read", read, py::arg("path"), "Reads a mesh: .obj, .ply, .off, .stl, .gltf or .glb. Raises Error.");
  m.def("write", write, py::arg("path"), py::arg("surface"), py::arg("faces") = py::none(),
        py::arg("vertices") = py::none(),
        "Writes a mesh atomically: .obj, .ply, .off, .stl, .gltf or .glb. Returns warnings, one line each, "
        "about content that the format does not support. Raises Error.\n\n"
        "surface: a Surface from read(); all content of its file is written. `vertices` (n, 3) replaces its "
        "vertices. Or an array of vertices (n, 3) with `faces` (m, k), or a list of lists.");
  const CageWish usual;
  m.def("make_cage", make, py::arg("vertices"), py::arg("faces"), py::arg("triangles") = usual.triangles,
        py::kw_only(), py::arg("kind") = usual.kind, py::arg("margin") = usual.margin,
        py::arg("gap") = usual.gap, py::arg("symmetry") = usual.symmetry, py::arg("quads") = false,
        py::arg("cells") = usual.cells, py::arg("own_axes") = false,
        "Makes a closed cage around the model, without self-intersections. Returns (vertices (k, 3), "
        "faces).\n\n"
        "triangles: approximate number, 12 to 20000; only for automatic cages.\n"
        "kind: 'automatic' or 'box' (with `cells` boxes along each axis, 1 to 32).\n"
        "margin: distance to the model as a fraction of its diagonal, 0.0005 to 0.2.\n"
        "gap: closes gaps narrower than twice this fraction of the diagonal, 0 to 0.2.\n"
        "symmetry: normal of the mirror plane: 'auto', 'none', 'x', 'y' or 'z'.\n"
        "quads: joins pairs of triangles to quads. own_axes: aligns boxes with the model's principal axes.\n"
        "Many triangles take seconds; Ctrl-C cancels. Raises Error.");
}

}  // namespace viete::python
