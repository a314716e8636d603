#include "files/shape_import.h"

#include <random>

#include "formats/morph_keys.h"
#include "formats/read.h"
#include "support/files.h"
#include "support/posed_cube.h"
#include "support/text.h"

using namespace viete;
using namespace viete::document;
using namespace viete::files;
using test::distance, test::mentions, test::put_file;
namespace fs = std::filesystem;

namespace {

using Points = std::vector<mesh::Point>;

// A folder with a model and files of its shapes.
struct ShapeFiles : test::TemporaryFolder {
  mesh::Surface model = test::CubeFiles::subdivided_cube();

  Points moved(double degrees) const {
    Points points = test::turned(model.positions, degrees);
    for (auto& p : points) p[0] += p[2] * p[2] / 3;
    return points;
  }
  fs::path write(const std::string& name, const mesh::Surface& surface) const {
    formats::write(*this / name, surface);
    return *this / name;
  }
  fs::path write(const std::string& name, Points points) const {
    mesh::Surface surface = model;
    surface.positions = std::move(points);
    return write(name, surface);
  }
  ImportedShapes read(const std::string& name) const {
    const fs::path file = *this / name;
    return read_shapes({&file, 1}, model);
  }
  std::string problem(const std::string& name) const {
    return test::problem_of([&] { read(name); });
  }
  void write_cache(const std::string& name, const std::vector<Points>& frames) const {
    test::write_cache(*this / name, frames);
  }
};

// Returns the surface with its vertices in random order.
mesh::Surface shuffled(const mesh::Surface& surface) {
  std::vector<std::uint32_t> order(surface.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::shuffle(order, std::mt19937(3));
  mesh::Surface all = surface;
  for (std::size_t v = 0; v < order.size(); ++v) all.positions[order[v]] = surface.positions[v];
  for (auto& c : all.corners) c = order[c];
  for (auto& t : all.triangles) t = {order[t[0]], order[t[1]], order[t[2]]};
  return all;
}

mesh::Surface surface_of(const fs::path& file, const std::string& text) {
  put_file(file, text);
  return formats::read(file).surface;
}

}  // namespace

TEST_CASE("a_shape_is_a_model_of_any_format_in_the_order_of_its_vertices") {
  const ShapeFiles f;
  const Points moved = f.moved(50);
  for (const char* name : {"a.obj", "a.ply", "a.off", "a.stl", "a.glb"}) {
    CAPTURE(name);
    f.write(name, moved);
    const ImportedShapes read = f.read(name);
    REQUIRE(read.shapes.size() == 1);
    CHECK(read.shapes[0].name == "a");
    CHECK(read.files == std::vector<fs::path>{f / name});
    const bool keeps_order = std::string(name).find_first_of("sg", 2) == std::string::npos;
    CHECK(read.warnings.empty() == keeps_order);
    if (keeps_order) CHECK(*read.shapes[0].shape == moved);
    CHECK(distance(*read.shapes[0].shape, moved) < 1e-6);
  }
}

TEST_CASE("faces_tell_vertices_that_stand_in_another_order") {
  const ShapeFiles f;
  mesh::Surface surface = f.model;
  surface.positions = f.moved(120);
  f.write("a.obj", shuffled(surface));
  const ImportedShapes read = f.read("a.obj");
  CHECK(*read.shapes.at(0).shape == surface.positions);
  REQUIRE(read.warnings.size() == 1);
  CHECK(mentions(read.warnings[0], "a.obj: the vertex order differs"));
}

TEST_CASE("shapes_without_faces_or_with_faces_in_another_order_are_read") {
  const ShapeFiles f;
  mesh::Surface surface = f.model;
  surface.positions = f.moved(70);
  std::ranges::reverse(surface.triangles);
  for (auto& t : surface.triangles) std::ranges::rotate(t, t.begin() + 1);
  f.write("order.obj", mesh::from_triangles(surface.positions, surface.triangles));
  f.write("points.obj", mesh::from_triangles(surface.positions, {}));
  for (const char* name : {"order.obj", "points.obj"}) {
    const ImportedShapes read = f.read(name);
    CHECK(*read.shapes.at(0).shape == surface.positions);
    for (const std::string& warning : read.warnings) CHECK(mentions(warning, "the file has no faces"));
  }
}

TEST_CASE("polygons_are_told_by_the_triangles_that_they_are_cut_into") {
  ShapeFiles f;
  const std::string quads = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0.5\nf 1 2 3 4\nf 2 5 6 3\n";
  f.model = surface_of(f / "quads.obj", quads);
  CHECK(*f.read("quads.obj").shapes.at(0).shape == f.model.positions);
  f.write("cut.stl", f.model);
  CHECK(*f.read("cut.stl").shapes.at(0).shape == f.model.positions);
  put_file(f / "other.obj", quads.substr(0, quads.find("f 2")) + "f 2 5 6\n");
  CHECK(mentions(f.problem("other.obj"), "has the vertices 1 4 5, in the model 1 4 5 2"));
}

TEST_CASE("vertices_of_no_face_keep_their_order") {
  ShapeFiles f;
  f.model = surface_of(f / "m.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 8 8 8\nv 0 1 0\nf 2 3 5\n");
  put_file(f / "s.obj", "v 0 0 5\nv 0 1 5\nv 7 7 7\nv 1 0 5\nv 6 6 6\nf 1 4 2\n");
  CHECK(*f.read("s.obj").shapes.at(0).shape == Points{{7, 7, 7}, {0, 0, 5}, {1, 0, 5}, {6, 6, 6}, {0, 1, 5}});
  f.model = surface_of(f / "m.obj", "v 0 0 0\nv 1 0 0\n");
  put_file(f / "s.obj", "v 3 0 0\nv 4 0 0\n");
  CHECK(f.read("s.obj").shapes.at(0).shape->at(1) == mesh::Point{4, 0, 0});
}

TEST_CASE("the_first_thing_that_differs_is_named") {
  const ShapeFiles f;
  f.write("other.obj", test::cube(1));
  CHECK(mentions(f.problem("other.obj"), "the file has 8 vertices, the model has 20; choose"));
  mesh::Surface changed = f.model;
  changed.triangles.pop_back();
  f.write("fewer.obj", mesh::from_triangles(changed.positions, changed.triangles));
  CHECK(mentions(f.problem("fewer.obj"), "the file has 35 faces, the model has 36; choose"));
  changed = f.model;
  std::swap(changed.triangles[5][0], changed.triangles[5][1]);
  f.write("turned.obj", mesh::from_triangles(changed.positions, changed.triangles));
  CHECK(mentions(f.problem("turned.obj"), "turned.obj: face 5 (counted from 0) has the vertices "));
  std::ranges::reverse(changed.triangles);
  f.write("reversed.obj", mesh::from_triangles(changed.positions, changed.triangles));
  CHECK(f.problem("reversed.obj") != "");
  CHECK(mentions(f.problem("none.obj"), "there is no such file"));
}

TEST_CASE("a_numbered_name_stands_for_its_files_by_number") {
  const ShapeFiles f;
  for (const int n : {10, 2, 9}) f.write("p_" + std::to_string(n) + ".ply", f.moved(10 * n));
  const ImportedShapes read = f.read("p_#.ply");
  REQUIRE(read.shapes.size() == 3);
  for (const auto& [at, n] : {std::pair(0, 2), {1, 9}, {2, 10}}) {
    CHECK(read.shapes[std::size_t(at)].name == "p_" + std::to_string(n));
    CHECK(*read.shapes[std::size_t(at)].shape == f.moved(10 * n));
  }
  CHECK(read.files.size() == 3);
  CHECK(mentions(f.problem("q_##.ply"), "q_##.ply: no file matches this name with digits"));
  f.write("p_3.ply", test::cube(1));
  CHECK(mentions(f.problem("p_#.ply"), "p_3.ply: the file has 8 vertices"));
}

TEST_CASE("a_point_cache_is_a_shape_a_frame") {
  const ShapeFiles f;
  for (const std::string name : {"c.pc2", "c.mdd"}) {
    CAPTURE(name);
    f.write_cache(name, {f.moved(0), f.moved(30), f.moved(60)});
    const ImportedShapes read = f.read(name);
    REQUIRE(read.shapes.size() == 3);
    CHECK(read.shapes[1].name == "frame 2");
    CHECK(distance(*read.shapes[2].shape, f.moved(60)) < 1e-6);
    f.write_cache(name, {f.moved(30)});
    CHECK(f.read(name).shapes.front().name == "c");
    f.write_cache(name, {test::cube(1).positions});
    CHECK(mentions(f.problem(name), "the file has 8 points, and the model has 20 vertices"));
  }
  f.write_cache("many.pc2", std::vector<Points>(Timeline::most_keys + 1, f.model.positions));
  CHECK(mentions(f.problem("many.pc2"), "there are 10001 shapes, and a timeline can have 10,000"));
}

TEST_CASE("morph_targets_are_shapes_of_their_names") {
  const ShapeFiles f;
  const Points smile = f.moved(10), frown = f.moved(-20);
  test::write_morphs(f / "face.glb", {f.model, f.model.positions, {}}, nullptr,
                     test::MorphAnimation{"", {{0, "smile", smile}, {1, "frown", frown}}});
  const ImportedShapes read = f.read("face.glb");
  CHECK(read.warnings.empty());
  REQUIRE(read.shapes.size() == 2);
  CHECK(read.shapes[0].name == "smile");
  CHECK(read.shapes[1].name == "frown");
  CHECK(distance(*read.shapes[0].shape, smile) < 1e-6);
  CHECK(distance(*read.shapes[1].shape, frown) < 1e-6);
  test::write_morphs(f / "moved.glb", {f.model, smile, {}}, nullptr,
                     test::MorphAnimation{"", {{0, "frown", frown}}});
  CHECK(mentions(f.problem("moved.glb"), "the rest shape differs from the model"));
}

TEST_CASE("positions_farther_away_than_can_be_drawn_are_refused") {
  const ShapeFiles f;
  Points points = f.model.positions;
  points[3][2] = -1e33;
  f.write("far.obj", points);
  CHECK(mentions(f.problem("far.obj"), "far.obj: vertex 3 is too far away to be drawn"));
  f.write_cache("far.pc2", {f.model.positions, points});
  CHECK(mentions(f.problem("far.pc2"), "far.pc2: frame 2: vertex 3 is too far away"));
}
