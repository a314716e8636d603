#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "library/arguments.h"
#include "python/meshes.h"

namespace viete::python {

namespace {

namespace fs = std::filesystem;
using Number = std::optional<double>;

/// Returns a copy of the numbers as an array (n, N).
template <std::size_t N>
py::array_t<float> copy_of(std::span<const std::array<float, N>> rows) {
  return py::array_t<float>({rows.size(), N}, reinterpret_cast<const float*>(rows.data()));
}

py::array_t<float> opacities_of(const Splats& splats) {
  return py::array_t<float>(std::ssize(splats.opacities()), splats.opacities().data());
}

py::array_t<float> harmonics_of(const Splats& splats) {
  const std::size_t count = splats.opacities().size(), all = splats.harmonics().size();
  return py::array_t<float>({count, std::size_t{3}, count > 0 ? all / (3 * count) : 0},
                            splats.harmonics().data());
}

Splats deformed(const Splats& splats, const py::object& cage_vertices, const py::object& cage_faces,
                const py::object& pose, const std::string& name, const std::string& weights,
                const std::string& blend, Number radius, Number rotation, Number stretch, bool arap,
                std::optional<int> iterations, Number attach, Number hold, const std::string& method,
                int threads) {
  const Mesh cage = mesh_of("Splats.deform", cage_vertices, cage_faces);
  const Contiguous<double> to = rows_of_3("Splats.deform", pose);
  const Blending blending{name, weights,    blend,  radius, rotation, stretch,
                          arap, iterations, attach, hold,   method};
  const py::gil_scoped_release release;
  return splats.deformed(cage, numbers_of(to), blending, threads, heed_signals);
}

}  // namespace

void define_splats(py::module_& m) {
  const auto none = py::none();
  py::class_<Splats>(m, "Splats",
                     "A capture of Gaussian splats. Never changes. Arrays are copies, as in PLY files.")
      .def(py::init([](const fs::path& file) {
             const py::gil_scoped_release release;
             return Splats(file);
           }),
           py::arg("path"), "Reads .ply with scale_0, rot_0 and opacity, or .spz. Raises Error.")
      .def("__len__", [](const Splats& s) { return s.opacities().size(); })
      .def_property_readonly(
          "vertices", [](const Splats& s) { return array_of(s.vertices()); }, "Centres, (n, 3) float64.")
      .def_property_readonly(
          "log_scales", [](const Splats& s) { return copy_of(s.log_scales()); },
          "Logarithms of the standard deviations along the axes, (n, 3) float32.")
      .def_property_readonly(
          "rotations", [](const Splats& s) { return copy_of(s.rotations()); },
          "Quaternions w, x, y, z of any length, (n, 4) float32; the axes are the columns of their matrices.")
      .def_property_readonly("opacities", opacities_of, "Logits of the opacities, (n,) float32.")
      .def_property_readonly(
          "colors", [](const Splats& s) { return copy_of(s.colors()); },
          "Coefficients of the constant spherical harmonic, (n, 3) float32.")
      .def_property_readonly("harmonics", harmonics_of,
                             "Coefficients of the other harmonics, (n, 3, k) float32 with k = 0, 3, 8 or 15.")
      .def_property_readonly(
          "notes", [](const Splats& s) { return s.notes(); }, "Warnings about the file, one line each.")
      .def("deform", deformed, py::arg("cage_vertices"), py::arg("cage_faces"), py::arg("pose"),
           py::arg("deformer") = "smooth", py::kw_only(), py::arg("weights") = "", py::arg("blend") = "",
           py::arg("radius") = none, py::arg("rotation") = none, py::arg("stretch") = none,
           py::arg("arap") = false, py::arg("iterations") = none, py::arg("attach") = none,
           py::arg("hold") = none, py::arg("method") = "fast", py::arg("threads") = 0,
           "Returns new splats whose centres, sizes, rotations and colours follow the cage, with the bits of "
           "`viete "
           "deform`.\n\ncage_vertices (k, 3), cage_faces: the cage at rest. pose (k, 3): its posed vertices. "
           "Other "
           "arguments are those of Deformer. Ctrl-C cancels. Raises Error.")
      .def(
          "write",
          [](const Splats& s, const fs::path& file) {
            const py::gil_scoped_release release;
            return s.write(file);
          },
          py::arg("path"),
          "Writes .ply or .spz atomically, with all other content of the file that was read. Other formats "
          "get only "
          "the centres. Returns warnings, one line each. Raises Error.");
}

}  // namespace viete::python
