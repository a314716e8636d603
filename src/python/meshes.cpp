#include "python/meshes.h"

#include <algorithm>
#include <limits>
#include <string>

namespace viete::python {

Contiguous<double> rows_of_3(const char* what, const py::object& object) {
  const auto array = numbers(what, "an array of points", object, false);
  if (array.ndim() != 2 || array.shape(1) != 3)
    wrong(what, "points must be (n, 3); this shape is " + shape_text(array));
  return array;
}

std::span<const double> numbers_of(const Contiguous<double>& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

Points points_of(const char* what, const py::object& object) {
  const Contiguous<double> array = rows_of_3(what, object);
  Points points(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t v = 0; v < points.size(); ++v) std::copy_n(array.data() + 3 * v, 3, points[v].begin());
  return points;
}

py::array_t<double> array_of(const Points& points) {
  py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
  for (std::size_t v = 0; v < points.size(); ++v)
    std::copy_n(points[v].begin(), 3, array.mutable_data() + 3 * v);
  return array;
}

namespace {

// Adds faces from an array (m, k) or a list of sequences.
void add_faces(const char* what, const py::object& faces, Mesh& mesh) {
  using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
  const auto add = [&](const std::int64_t* corners, py::ssize_t count) {
    for (const std::int64_t corner : std::span(corners, static_cast<std::size_t>(count))) {
      if (corner < 0 || corner >= std::numeric_limits<std::uint32_t>::max())
        wrong(what, "a face has an invalid vertex index (indices start at 0): " + std::to_string(corner));
      mesh.corners.push_back(static_cast<std::uint32_t>(corner));
    }
    mesh.starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  };
  const auto integers_of = [&](const py::handle& object) {
    const auto given = array_like(object);
    const char kind = given ? given->dtype().kind() : '?';
    if (!given || (kind != 'i' && kind != 'u' && given->size() > 0))
      throw py::type_error("viete." + std::string(what) +
                           ": faces must be integers, (m, corners), or a list of lists if the numbers of "
                           "corners differ");
    return Integers(*given);  // integers above 2^63 become negative, and add() rejects them
  };
  mesh.starts = {0};
  if (py::isinstance<py::buffer>(faces)) {
    const Integers all = integers_of(faces);
    if (all.ndim() != 2)
      wrong(what, "faces must be (m, corners) or a list; this shape is " + shape_text(all));
    for (py::ssize_t f = 0; f < all.shape(0); ++f) add(all.data() + f * all.shape(1), all.shape(1));
    return;
  }
  for (const py::handle face : faces) {
    const Integers corners = integers_of(face);
    if (corners.ndim() != 1) wrong(what, "each face must be a list of vertex indices");
    add(corners.data(), corners.shape(0));
  }
}

}  // namespace

Mesh mesh_of(const char* what, const py::object& vertices, const py::object& faces) {
  Mesh mesh{points_of(what, vertices), {}, {}};
  add_faces(what, faces, mesh);
  return mesh;
}

py::object faces_of(const Mesh& mesh) {
  const auto& [corners, starts] = std::tie(mesh.corners, mesh.starts);
  const std::size_t count = mesh.face_count();
  const std::size_t k = count > 0 ? starts[1] - starts[0] : 3;
  bool even = true;
  for (std::size_t f = 0; f < count; ++f) even &= starts[f + 1] - starts[f] == k;
  const auto array = [&](std::size_t from, std::vector<py::ssize_t> shape) {
    py::array_t<std::int32_t> faces(std::move(shape));
    std::copy_n(corners.begin() + static_cast<std::ptrdiff_t>(from), faces.size(), faces.mutable_data());
    return faces;
  };
  if (even) return array(0, {static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(k)});
  py::list all;
  for (std::size_t f = 0; f < count; ++f)
    all.append(array(starts[f], {static_cast<py::ssize_t>(starts[f + 1] - starts[f])}));
  return all;
}

void heed_signals(double) {
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace viete::python
