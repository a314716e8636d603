#include "python/deformation.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "base/error.h"
#include "library/deform.h"
#include "library/surfaces.h"
#include "mesh/formats/read.h"
#include "mesh/formats/write.h"
#include "python/matrices.h"

namespace viete::python {

namespace {

namespace fs = std::filesystem;
using Points = std::vector<Point3>;

// (n, 3) of any real type, order and strides, as doubles one after the other.
py::array_t<double> rows_of_3(const char* what, const py::object& object) {
  const py::array array = as_array(what, object);
  is_single(what, array);
  if (array.ndim() != 2 || array.shape(1) != 3)
    wrong(what, "places are (n, 3), x, y, z each; this shape is " + shape_text(array));
  auto doubles = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!doubles) throw py::error_already_set();
  return doubles;
}

std::span<const double> numbers_of(const py::array_t<double>& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

Points points_of(const char* what, const py::object& object) {
  const py::array_t<double> array = rows_of_3(what, object);
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

std::uint32_t corner_of(const char* what, std::int64_t corner) {
  if (corner < 0 || corner >= std::numeric_limits<std::uint32_t>::max())
    wrong(what, "a face has a corner " + std::to_string(corner) + "; vertices are counted from 0");
  return static_cast<std::uint32_t>(corner);
}

// One face after the other, of an array (m, k) or of sequences of their own length each.
void add_faces(const char* what, const py::object& faces, Mesh& mesh) {
  using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
  const auto add = [&](const std::int64_t* corners, py::ssize_t count) {
    for (py::ssize_t c = 0; c < count; ++c) mesh.corners.push_back(corner_of(what, corners[c]));
    mesh.starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  };
  const auto integers_of = [&](const py::handle& object) {
    const py::array array = py::array::ensure(object);
    if (!array || (array.dtype().kind() != 'i' && array.dtype().kind() != 'u' && array.size() > 0)) {
      PyErr_Clear();
      throw py::type_error("viete." + std::string(what) + ": corners of faces are whole numbers");
    }
    return Integers::ensure(array);
  };
  mesh.starts = {0};
  if (py::isinstance<py::array>(faces)) {
    const Integers all = integers_of(faces);
    if (all.ndim() != 2) wrong(what, "faces are (m, corners), or a list; this shape is " + shape_text(all));
    for (py::ssize_t f = 0; f < all.shape(0); ++f) add(all.data(f, 0), all.shape(1));
    return;
  }
  if (!py::isinstance<py::sequence>(faces))
    throw py::type_error("viete." + std::string(what) + ": faces are an array or a list");
  for (const py::handle face : faces) {
    const Integers corners = integers_of(face);
    if (corners.ndim() != 1) wrong(what, "each face is a list of its corners");
    add(corners.data(), corners.shape(0));
  }
}

Mesh mesh_of(const char* what, const py::object& vertices, const py::object& faces) {
  Mesh mesh{points_of(what, vertices), {}, {}};
  add_faces(what, faces, mesh);
  return mesh;
}

// (m, k) where all have as many corners, else a list.
py::object faces_of(const std::vector<std::uint32_t>& corners, const std::vector<std::uint32_t>& starts) {
  const std::size_t count = starts.empty() ? 0 : starts.size() - 1;
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

// --- files

struct SurfaceOfFile {
  mesh::ReadResult read;
};

SurfaceOfFile read_surface(const fs::path& file) {
  const py::gil_scoped_release release;
  return {mesh::read(file)};
}

// With all that was in its file, where the vertices of one move.
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
    if (!faces.is_none()) wrong("write", "a surface has faces of its own: leave them out");
    return write_moved(file, surface.cast<const SurfaceOfFile&>(), vertices);
  }
  if (faces.is_none()) wrong("write", "arrays of vertices need faces");
  if (!vertices.is_none()) wrong("write", "vertices are named once, or with a surface that was read");
  const Mesh mesh = mesh_of("write", surface, faces);
  const py::gil_scoped_release release;
  write_mesh(file, mesh);
  return {};
}

// --- deformer

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
    const bool lies = (result_.flags() & direct) == direct;
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
    throw py::type_error("viete.Deformer.deform: " + std::string(what) + " is an array");
  const auto array = py::reinterpret_borrow<py::array>(out);
  if (array.dtype().kind() != 'f' || (array.itemsize() != 4 && array.itemsize() != 8))
    throw py::type_error("viete.Deformer.deform: " + std::string(what) + " is float32 or float64");
  return array;
}

class PythonDeformer {
public:
  PythonDeformer(const Mesh& model, const Mesh& cage, const Blending& blending, int threads, bool single)
      : deformer_(model, cage, blending, threads), single_(single) {}

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
      const py::gil_scoped_release release;
      const std::lock_guard lock(*mutex_);
      deformer_.deform(from, places, directions, keeps_turns ? &turns_ : nullptr);
    }
    if (!of_normals) return to.finish();
    const py::array first = to.finish();
    return py::make_tuple(first, of_normals->finish());
  }

  template <class Act>
  void change(const Act& act) {
    const py::gil_scoped_release release;
    const std::lock_guard lock(*mutex_);
    act(deformer_);
  }
  const Deformer& deformer() const { return deformer_; }
  void forget_turns() { turns_.clear(); }

  bool keeps_turns = false;

private:
  Deformer deformer_;
  bool single_;
  Points turns_;
  std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
};

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
  return from.contains(key) ? from[key].cast<T>() : otherwise;
}

Probe probe_of(const py::dict& words) {
  for (const auto& [key, value] : words) {
    const auto name = key.cast<std::string>();
    if (name != "place" && name != "radius" && name != "falloff" && name != "turn" && name != "stretch" &&
        name != "move")
      wrong("Deformer.set_probes", "a probe has place, radius, falloff, turn, stretch and move, not " + name);
  }
  if (!words.contains("place")) wrong("Deformer.set_probes", "a probe needs a place");
  Probe probe;
  probe.place = words["place"].cast<Point3>();
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
    const auto array = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(mask);
    if (!array || array.ndim() != 1) wrong("Deformer.set_mask", "a mask is (n,), a share for each vertex");
    shares.assign(array.data(), array.data() + array.size());
  }
  d.change([&](Deformer& deformer) { deformer.set_mask(shares); });
}

void set_shape(PythonDeformer& d, const py::object& shape) {
  if (shape.is_none()) return d.change([](Deformer& deformer) { deformer.set_shape({}); });
  const py::array_t<double> array = rows_of_3("Deformer.set_shape", shape);
  d.change([from = numbers_of(array)](Deformer& deformer) { deformer.set_shape(from); });
}

// --- spaces

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
  std::unique_ptr<std::mutex> mutex = std::make_unique<std::mutex>();

  template <class Act>
  auto with(const Act& act) const {
    const py::gil_scoped_release release;
    const std::lock_guard lock(*mutex);
    return act(space);
  }
};
using Shapes = Guarded<ShapeSpace>;
using Poses = Guarded<PoseSpace>;
using Sessions = Guarded<Session>;

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
      "The sum of all, each times its weight, (n, 3): 0 is rest, [1, 0, ...] the first one.");
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
  const Points positions =
      shapes.with([&](const ShapeSpace& s) { return s.pose(vertices, to, firmness, freedom, &weights); });
  return py::make_tuple(array_of(positions), py::cast(weights));
}

void define_files(py::module_& m) {
  py::class_<SurfaceOfFile>(m, "Surface", "What read() gives: a mesh, and all else that its file says of it.")
      .def_property_readonly(
          "vertices",
          [](const SurfaceOfFile& s) { return array_of(library::outside(s.read.surface.positions)); },
          "(n, 3) float64, a copy.")
      .def_property_readonly(
          "faces",
          [](const SurfaceOfFile& s) {
            return faces_of(s.read.surface.corners, s.read.surface.polygon_starts);
          },
          "(m, k) int32 where all have k corners, else a list of arrays.")
      .def_property_readonly(
          "triangles",
          [](const SurfaceOfFile& s) {
            py::array_t<std::int32_t> all(
                {static_cast<py::ssize_t>(s.read.surface.triangles.size()), py::ssize_t{3}});
            std::int32_t* to = all.mutable_data();
            for (const auto& t : s.read.surface.triangles) to = std::copy(t.begin(), t.end(), to);
            return all;
          },
          "(t, 3) int32: the faces, cut into triangles.")
      .def_property_readonly(
          "format", [](const SurfaceOfFile& s) { return s.read.format; },
          "Of the file: 'OBJ', 'PLY ascii', ...")
      .def_property_readonly(
          "notes", [](const SurfaceOfFile& s) { return s.read.warnings; },
          "What a person should know of it, one line each.");
  m.def("read", read_surface, py::arg("path"), "A mesh of a file: OBJ, PLY, OFF, STL, glTF. Raises Error.");
  m.def("write", write_surface, py::arg("path"), py::arg("surface"), py::arg("faces") = py::none(),
        py::arg("vertices") = py::none(),
        "Writes a mesh whole or not at all; the extension chooses the format. Returns notes, one line each. "
        "Raises Error.\n\n"
        "surface: what read() gave: all that was in its file is written again, its vertices at `vertices` "
        "(n, 3) where "
        "these are named. Or vertices (n, 3), with faces: (m, k), or a list of lists.");
  m.def(
      "make_cage",
      [](const py::object& vertices, const py::object& faces, std::size_t triangles, const std::string& kind,
         double margin, double gap, const std::string& symmetry, bool quads,
         const std::array<std::size_t, 3>& cells, bool own_axes) {
        const Mesh model = mesh_of("make_cage", vertices, faces);
        Mesh cage;
        {
          const py::gil_scoped_release release;
          cage = make_cage(model, {kind, triangles, margin, gap, symmetry, quads, cells, own_axes});
        }
        return py::make_tuple(array_of(cage.vertices), faces_of(cage.corners, cage.starts));
      },
      py::arg("vertices"), py::arg("faces"), py::arg("triangles") = 200, py::kw_only(),
      py::arg("kind") = "automatic", py::arg("margin") = CageWish{}.margin, py::arg("gap") = CageWish{}.gap,
      py::arg("symmetry") = "auto", py::arg("quads") = false, py::arg("cells") = CageWish{}.cells,
      py::arg("own_axes") = false,
      "vertices (k, 3), faces: a closed cage around the model, free of self-intersection.\n\n"
      "triangles: about so many, 12 to 20000. kind: 'automatic', 'box' (of cells along each axis) or 'hull'. "
      "margin, gap: "
      "distance, and half the width of gaps that are closed, in diagonals of the model. symmetry: 'auto', "
      "'none', 'x', "
      "'y', 'z'. quads: pairs of triangles become quads. own_axes: boxes along the model's extents. Raises "
      "Error.");
}

void define_deformer(py::module_& m) {
  py::class_<PythonDeformer>(m, "Deformer", "One model bound to one cage.")
      .def(py::init([](const py::object& vertices, const py::object& faces, const py::object& cage_vertices,
                       const py::object& cage_faces, const std::string& way, const std::string& elements,
                       const std::string& weights, const std::string& blend, std::optional<double> reach,
                       std::optional<double> radius, std::optional<int> exponent, std::optional<bool> clamp,
                       bool normalise, std::optional<double> turn, std::optional<double> stretch,
                       std::optional<int> stitched, std::optional<double> pins, std::optional<double> hold,
                       const std::string& method, int threads, const py::object& dtype) {
             if (threads < 0 || threads > 1024) wrong("Deformer", "threads are 0 (all processors) to 1024");
             return make_deformer(vertices, faces, cage_vertices, cage_faces,
                                  {way, elements, weights, blend, reach, radius, exponent, clamp, normalise,
                                   turn, stretch, stitched, pins, hold, method},
                                  threads, dtype);
           }),
           py::arg("vertices"), py::arg("faces"), py::arg("cage_vertices"), py::arg("cage_faces"),
           py::arg("way") = "smooth", py::kw_only(), py::arg("elements") = "", py::arg("weights") = "",
           py::arg("blend") = "", py::arg("reach") = py::none(), py::arg("radius") = py::none(),
           py::arg("exponent") = py::none(), py::arg("clamp") = py::none(), py::arg("normalise") = false,
           py::arg("turn") = py::none(), py::arg("stretch") = py::none(), py::arg("stitched") = py::none(),
           py::arg("pins") = py::none(), py::arg("hold") = py::none(), py::arg("method") = "fast",
           py::arg("threads") = 0, py::arg("dtype") = "float64",
           "Binds the model, vertices (n, 3) and faces (m, k), or a list of lists, to the cage at rest; "
           "fractions of a second to "
           "some seconds. All is copied. Raises Error.\n\n"
           "way: 'smooth', 'paper', 'mean-value', 'rigid', 'arap' or 'local'.\n"
           "elements, weights, blend: words of the command line, in place of what the way has.\n"
           "reach (1.5 or more), radius (in sizes of the cage), exponent (1 to 8), clamp, normalise: of "
           "weights that have them.\n"
           "turn, stretch: how much of rotations and stretches acts, 0 to 2.\n"
           "stitched: how often a stitched model is solved for, 1 to 20; pins, hold: what holds it, 0 to 1.\n"
           "method: 'fast', 'diag', 'sd' or 'improved_sd'.\n"
           "threads: 0 for all processors.\n"
           "dtype: of what deform() makes: float64 with the bits of viete deform, or float32, three to nine "
           "times as fast.")
      .def("deform", &PythonDeformer::deform, py::arg("cage"), py::arg("out") = py::none(),
           py::arg("normals") = py::none(),
           "The model's vertices (n, 3) for the cage's, (k, 3), as they are posed.\n\n"
           "out: where they go, float32 or float64, of any strides. normals: an array of the same type for "
           "normals, or True; "
           "then vertices, normals are returned. Other Python threads run meanwhile; calls of one deformer "
           "take turns.")
      .def_readwrite("keeps_turns", &PythonDeformer::keeps_turns,
                     "False at first: each part of the cage turns the least. True: as near as can be to the "
                     "pose before, so that parts "
                     "may turn round and round.")
      .def("forget_turns", &PythonDeformer::forget_turns, "The next pose turns the least.")
      .def("set_mask", set_mask, py::arg("mask"),
           "How much of its motion each vertex makes, (n,), 0 to 1; None: all of it.")
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
          "A layer upon the cage: dictionaries with place (x, y, z), and radius, falloff ('smooth', 'round', "
          "'linear', 'sharp', "
          "'even', 'endless'), turn (a rotation vector), stretch (a logarithm: xx xy xz yy yz zz) and move.")
      .def_property_readonly(
          "notes", [](const PythonDeformer& d) { return d.deformer().notes(); },
          "Of the cage, one line each.");
}

void define_spaces(py::module_& m) {
  py::class_<Shapes> shapes(m, "ShapeSpace",
                            "Shapes of one mesh in log space: halfway to a half turn is a quarter turn.");
  shapes.def(
      py::init([](const py::object& vertices, const py::object& faces, const py::object& all, int threads) {
        const Mesh rest = mesh_of("ShapeSpace", vertices, faces);
        const std::vector<Points> places = all_points("ShapeSpace", all);
        const py::gil_scoped_release release;
        return Shapes{ShapeSpace(rest, places, threads)};
      }),
      py::arg("vertices"), py::arg("faces"), py::arg("shapes"), py::arg("threads") = 0,
      "vertices (n, 3) and faces at rest; shapes: (n, 3) each, in the order of a motion. Raises Error.");
  define_sums(shapes);
  shapes.def("pose", pose_by_pins, py::arg("vertices"), py::arg("places"),
             py::arg("firmness") = std::numeric_limits<double>::infinity(), py::arg("freedom") = 0.3,
             "positions (n, 3), weights: the shape among mixes, and near them, that has these vertices "
             "(their numbers) at these places "
             "(p, 3).\n\nfirmness: infinite holds them, 0.3 pulls about as strongly as neighbours do. "
             "freedom: 0 as the shapes say, 1 as "
             "rigid as can be.");
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
          "The model's vertices (n, 3) at that frame, as viete animate writes them; without keys as it is "
          "posed.")
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

// Options are words here.
std::string in_python(std::string sentence) {
  return sentence.starts_with("--") ? sentence.substr(2) : sentence;
}

}  // namespace

void define_deformation(py::module_& m) {
  static PyObject* const error = PyErr_NewExceptionWithDoc(
      "viete.Error", "What is wrong with files or arrays, and what to do.", PyExc_ValueError, nullptr);
  m.attr("Error") = py::reinterpret_borrow<py::object>(error);
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const base::Error& e) {
      PyErr_SetString(error, in_python(e.what()).c_str());
    }
  });
  define_files(m);
  define_deformer(m);
  define_spaces(m);
  define_session(m);
}

}  // namespace viete::python
