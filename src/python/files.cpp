#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "library/surfaces.h"
#include "mesh/formats/read.h"
#include "mesh/formats/write.h"
#include "python/deformation.h"
#include "python/meshes.h"

namespace viete::python {

namespace {

struct SurfaceOfFile {
  mesh::ReadResult read;
};

}  // namespace

}  // namespace viete::python

namespace pybind11::detail {

template <>
struct type_caster<viete::python::SurfaceOfFile> : viete::python::Initialised<viete::python::SurfaceOfFile> {
};

}  // namespace pybind11::detail

namespace viete::python {

namespace {

namespace fs = std::filesystem;

SurfaceOfFile read_surface(const fs::path& file) {
  const py::gil_scoped_release release;
  return {mesh::read(file)};
}

// Writes all content of the original file with moved vertices.
std::vector<std::string> write_moved(const fs::path& file, const SurfaceOfFile& surface,
                                     const py::object& vertices) {
  const mesh::Surface& s = surface.read.surface;
  const std::vector<mesh::Point> moved =
      vertices.is_none() ? s.positions : library::inside(points_of("write", vertices));
  library::check_points(moved, s.positions.size(), "vertices");
  const py::gil_scoped_release release;
  const mesh::Content content{s, moved, {}, surface.read.attributes.get()};
  return mesh::write(file, content, surface.read.original.get(), {});
}

std::vector<std::string> write_surface(const fs::path& file, const py::object& surface,
                                       const py::object& faces, const py::object& vertices) {
  if (py::isinstance<SurfaceOfFile>(surface)) {
    if (!faces.is_none()) wrong("write", "a surface already has faces; omit faces");
    return write_moved(file, surface.cast<const SurfaceOfFile&>(), vertices);
  }
  if (faces.is_none()) wrong("write", "faces are required with an array of vertices");
  if (!vertices.is_none()) wrong("write", "vertices= is only allowed with a surface from read()");
  const Mesh mesh = mesh_of("write", surface, faces);
  const py::gil_scoped_release release;
  write_mesh(file, mesh);
  return {};
}

template <class T>
py::array_t<T> filled(std::size_t rows, std::size_t columns, T value) {
  py::array_t<T> array({static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns)});
  std::fill_n(array.mutable_data(), array.size(), value);
  return array;
}

// A vector per corner, face by face; NaN if a corner has none.
template <class Vector>
py::object of_corners(const std::vector<Vector>& values, const std::vector<std::uint32_t>& corners) {
  if (values.empty()) return py::none();
  auto array = filled(corners.size(), Vector{}.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t c = 0; c < corners.size(); ++c)
    if (corners[c] != mesh::none)
      std::ranges::copy(values[corners[c]], array.mutable_data(py::ssize_t(c), 0));
  return array;
}

const mesh::Attributes& attributes_of(const SurfaceOfFile& s) {
  static const mesh::Attributes nothing;
  return s.read.attributes ? *s.read.attributes : nothing;
}

py::object colors_of(const SurfaceOfFile& s) {
  const auto& colors = attributes_of(s).colors;
  if (colors.empty()) return py::none();
  auto array = filled(colors.size(), 4, 0.0f);
  for (std::size_t v = 0; v < colors.size(); ++v)
    std::ranges::copy(colors[v], array.mutable_data(py::ssize_t(v), 0));
  return array;
}

std::vector<std::string> material_names(const SurfaceOfFile& s) {
  std::vector<std::string> names;
  for (const mesh::Material& material : attributes_of(s).materials) names.push_back(material.name);
  return names;
}

py::array_t<std::int32_t> face_materials(const SurfaceOfFile& s) {
  const std::size_t count = s.read.surface.polygon_count();
  py::array_t<std::int32_t> numbers(static_cast<py::ssize_t>(count));
  std::fill_n(numbers.mutable_data(), count, -1);
  for (const mesh::Group& group : attributes_of(s).groups)  // a group ends where the next begins
    std::fill(numbers.mutable_data() + group.first_polygon, numbers.mutable_data() + count,
              group.material == mesh::none ? -1 : static_cast<std::int32_t>(group.material));
  return numbers;
}

void define_attributes(py::class_<SurfaceOfFile>& surface) {
  surface.def_property_readonly("colors", colors_of, "Vertex colours, (n, 4) float32, RGBA, 0 to 1; or None.")
      .def_property_readonly(
          "corner_normals",
          [](const SurfaceOfFile& s) {
            return of_corners(attributes_of(s).normals, attributes_of(s).corner_normal);
          },
          "Normals of corners, face by face, (c, 3); NaN if a corner has none; or None.")
      .def_property_readonly(
          "corner_texture",
          [](const SurfaceOfFile& s) {
            return of_corners(attributes_of(s).texture_points, attributes_of(s).corner_texture);
          },
          "Texture coordinates of corners, (c, 2), v upwards; or None.")
      .def_property_readonly("materials", material_names, "Material names.")
      .def_property_readonly("face_materials", face_materials,
                             "Material index of each face, (m,) int32; -1: none.");
}

}  // namespace

void define_files(py::module_& m) {
  py::class_<SurfaceOfFile> surface(
      m, "Surface",
      "A mesh returned by read(), with all other content of its file. Arrays are copies; write() keeps all "
      "content of the file, also content without an attribute here.");
  surface
      .def_property_readonly(
          "vertices",
          [](const SurfaceOfFile& s) { return array_of(library::outside(s.read.surface.positions)); },
          "Vertex positions, (n, 3) float64, a copy.")
      .def_property_readonly(
          "faces",
          [](const SurfaceOfFile& s) {
            return faces_of(s.read.surface.corners, s.read.surface.polygon_starts);
          },
          "Vertex indices, (m, k) int32 if all faces have k corners, otherwise a list of arrays.")
      .def_property_readonly(
          "triangles",
          [](const SurfaceOfFile& s) {
            py::array_t<std::int32_t> all(
                {static_cast<py::ssize_t>(s.read.surface.triangles.size()), py::ssize_t{3}});
            std::int32_t* to = all.mutable_data();
            for (const auto& t : s.read.surface.triangles) to = std::copy(t.begin(), t.end(), to);
            return all;
          },
          "The triangulated faces, (t, 3) int32.")
      .def_property_readonly(
          "format", [](const SurfaceOfFile& s) { return s.read.format; },
          "Format of the file: 'OBJ', 'PLY ascii', ...")
      .def_property_readonly(
          "notes", [](const SurfaceOfFile& s) { return s.read.warnings; },
          "Warnings about the file, one line each.");
  define_attributes(surface);
  m.def("read", read_surface, py::arg("path"),
        "Reads a mesh: .obj, .ply, .off, .stl, .gltf, .glb. Raises Error, also if the file does not exist.");
  m.def("write", write_surface, py::arg("path"), py::arg("surface"), py::arg("faces") = py::none(),
        py::arg("vertices") = py::none(),
        "Writes a mesh atomically: .obj, .ply, .off, .stl, .gltf or .glb. Returns warnings, one line each, "
        "about content that the format does not support. Raises Error.\n\n"
        "surface: a Surface from read(), written with all content of its file, and with its vertices at "
        "`vertices` (n, 3) where if given. Or an array of vertices (n, 3), with faces: (m, k), or a list of "
        "lists.");
  m.def(
      "make_cage",
      [](const py::object& vertices, const py::object& faces, std::int64_t triangles, const std::string& kind,
         double margin, double gap, const std::string& symmetry, bool quads,
         const std::array<std::size_t, 3>& cells, bool own_axes) {
        const Mesh model = mesh_of("make_cage", vertices, faces);
        if (triangles < 0) wrong("make_cage", "triangles must be 12 to 20000");
        Mesh cage;
        {
          const py::gil_scoped_release release;
          cage = make_cage(
              model,
              {kind, static_cast<std::size_t>(triangles), margin, gap, symmetry, quads, cells, own_axes},
              heed_signals);
        }
        return py::make_tuple(array_of(cage.vertices), faces_of(cage.corners, cage.starts));
      },
      py::arg("vertices"), py::arg("faces"), py::arg("triangles") = 200, py::kw_only(),
      py::arg("kind") = "automatic", py::arg("margin") = CageWish{}.margin, py::arg("gap") = CageWish{}.gap,
      py::arg("symmetry") = "auto", py::arg("quads") = false, py::arg("cells") = CageWish{}.cells,
      py::arg("own_axes") = false,
      "Makes a closed cage around the model, without self-intersections. Returns (vertices (k, 3), "
      "faces).\n\n"
      "triangles: approximate number, 12 to 20000; automatic cages only.\n"
      "kind: 'automatic' or 'box' (with `cells` boxes along each axis, 1 to 32).\n"
      "margin: distance to the model as a fraction of its diagonal, 0.0005 to 0.2. gap: closes gaps narrower "
      "than twice this fraction, 0 to 0.2.\n"
      "symmetry: 'auto', 'none', 'x', 'y', 'z'. quads: pairs triangles into quads. own_axes: aligns boxes "
      "with the model's principal axes.\n"
      "Takes seconds for many triangles; Ctrl-C cancels. Raises Error.");
}

}  // namespace viete::python
