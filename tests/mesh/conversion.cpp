// What a file says besides positions, in another format.
#include "mesh/formats/conversion.h"

#include <doctest/doctest.h>

#include "mesh/formats/write.h"
#include "mesh/shapes.h"
#include "support/gltf.h"

using namespace viete;
using namespace viete::mesh;
using viete::test::holds;

namespace {

// A square of two triangles with everything; the second corner's texture point differs in both.
const std::string everything =
    "mtllib some.mtl\no thing\ng part\nusemtl red\n"
    "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\ns off\n"
    "f 1/1/1 2/2/1 3/3/1\nusemtl blue\nf 1/4/1 3/3/1 4/4/1\n";

struct Converted : test::TemporaryFolder {
  ReadResult read = [this] {
    test::put_file(
        *this / "some.mtl",
        "newmtl red\nKd 1 0 0\nmap_Kd -clamp on pictures\\red.png\nnewmtl blue\nKd 0 0 1\nd 0.5\n");
    return test::read_kept(everything, "obj", path());
  }();

  // Turned a quarter about the x axis.
  std::vector<std::string> to(const std::string& name) {
    for (const Point& p : read.surface.positions) moved.push_back({p[0], -p[2], p[1]});
    return mesh::write(*this / name, Content{read.surface, moved, {}, read.attributes.get()}, nullptr, {});
  }
  std::vector<Point> moved;
};

}  // namespace

TEST_CASE("an_obj_made_of_another_file_has_its_attributes_and_a_library_beside_it") {
  Converted c;
  const auto notes = c.to("out.obj");
  REQUIRE(notes.size() == 1);
  CHECK(holds(notes[0], "out.mtl"));
  const ReadResult out = mesh::read(c / "out.obj");
  CHECK(out.surface.positions == c.moved);
  REQUIRE(out.attributes);
  const Attributes &now = *out.attributes, &before = *c.read.attributes;
  CHECK(now.texture_points == before.texture_points);
  CHECK(now.corner_texture == before.corner_texture);
  CHECK(now.colors == before.colors);
  REQUIRE(now.groups.size() == 2);
  CHECK(now.groups[0].object == "thing");
  CHECK(now.groups[0].name == "part");
  CHECK(!now.groups[1].smooth);
  REQUIRE(now.materials.size() == 2);
  CHECK(now.materials[0].base_color == Color{1, 0, 0, 1});
  CHECK(!now.materials[0].repeats);
  CHECK(now.materials[1].base_color == Color{0, 0, 1, 0.5F});
  CHECK(now.images[now.materials[0].base_color_image].path == c / "pictures" / "red.png");
  for (const std::uint32_t n : now.corner_normal) CHECK(norm(now.normals[n] - Vec3{0, -1, 0}) < 1e-12);
}

TEST_CASE("a_library_beside_an_obj_replaces_no_other_file") {
  Converted c;
  test::put_file(c / "out.mtl", "mine");
  CHECK(holds(c.to("out.obj").back(), "out-2.mtl"));
  CHECK(test::file_bytes(c / "out.mtl") == "mine");
  CHECK(mesh::read(c / "out.obj").attributes->materials[0].base_color == Color{1, 0, 0, 1});
  Converted twice;
  twice.to("out.obj");
  twice.moved.clear();
  CHECK(holds(twice.to("out.obj").back(), "out.mtl"));
}

TEST_CASE("a_ply_takes_what_there_is_one_of_a_vertex") {
  Converted c;
  const auto notes = c.to("out.ply");
  CHECK(notes == std::vector<std::string>{"PLY holds one a vertex of normals: 1 left out",
                                          "PLY has no groups: 2 left out",
                                          "PLY has no materials: 2 left out"});
  const ReadResult out = mesh::read(c / "out.ply");
  CHECK(out.surface.positions == c.moved);
  CHECK(out.attributes->colors == c.read.attributes->colors);
  const ReadResult smooth =
      test::read_kept("v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0.5 0.25\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n", "obj");
  const Content content{smooth.surface, smooth.surface.positions, {}, smooth.attributes.get()};
  CHECK(mesh::write(c / "smooth.ply", content, nullptr, {}).empty());
  const ReadResult again = mesh::read(c / "smooth.ply");
  CHECK(again.attributes->normals[2] == Vec3{0, 0, 1});
  CHECK(again.attributes->texture_points[1] == Vec2{0.5, 0.25});
}

TEST_CASE("what_a_file_holds_besides_is_said_where_another_format_does_not_get_it") {
  const test::TemporaryFolder folder;
  const auto notes_of = [&](const ReadResult& read, const char* name) {
    const Content content{read.surface, read.surface.positions, {}, read.attributes.get()};
    const auto notes = mesh::write(folder / name, content, read.original.get(), {});
    return notes.empty() ? std::string() : notes[0];
  };
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const ReadResult obj = test::read_kept(triangle + "l 1 2\nl 2 3\np 1\nlod 3\n", "obj");
  CHECK(notes_of(obj, "a.stl") ==
        "STL does not get what else was in the file: 2 lines, 1 point, 1 statement of curves, surfaces and "
        "display");
  CHECK(notes_of(obj, "a.obj") == "");
  CHECK(notes_of(test::read_kept(triangle, "obj"), "b.stl") == "");
  const ReadResult ply = test::read_kept(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
      "z\nproperty float "
      "quality\nelement edge 1\nproperty int vertex1\nend_header\n1 2 3 4\n0\n",
      "ply");
  CHECK(notes_of(ply, "a.off") ==
        "OFF does not get what else was in the file: property quality of vertex, element edge");
  test::GltfParts parts = test::patch();
  parts.json["animations"] = {{{"channels", test::GltfJson::array()}}};
  parts.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  parts.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = 2;
  CHECK(notes_of(test::read_kept(parts.glb(), "glb"), "a.ply") ==
        "PLY does not get what else was in the file: animations, morph targets, second texture coordinates");
}

TEST_CASE("what_gltf_does_not_hold_is_said") {
  const test::TemporaryFolder folder;
  const auto notes_of = [&](const std::string& obj) {
    const ReadResult read = test::read_kept(obj, "obj");
    const Content content{read.surface, read.surface.positions, {}, read.attributes.get()};
    return mesh::write(folder / "a.glb", content, read.original.get(), {});
  };
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  CHECK(notes_of(square + "o only\nf 1 2 3\nf 1 3 4\n").empty());
  CHECK(mesh::read(folder / "a.glb").attributes->groups.at(0).object == "only");
  CHECK(notes_of(square + "o one\nf 1 2 3 4\no two\nf 4 3 2 1\n") ==
        std::vector<std::string>{"2 faces of more than three corners became triangles",
                                 "glTF has no groups: 2 left out"});
  CHECK(mesh::read(folder / "a.glb").surface.positions.size() == 4);  // what belongs together stays so
  CHECK(notes_of(square + "v 0 0 1\nv 1 0 1\nv 1 1 1\no one\nf 1 2 3\no two\nf 5 6 7\no one\nf 1 3 4\n")
            .empty());
  const ReadResult two = mesh::read(folder / "a.glb");
  REQUIRE(two.attributes->groups.size() == 2);
  CHECK(two.attributes->groups[0].object == "one");
  CHECK(two.attributes->groups[1].object == "two");
  CHECK(two.attributes->groups[1].first_polygon == 2);
  CHECK(notes_of(square + "g left\nf 1 2 3\ng right\nf 1 3 4\n").size() == 1);
}

TEST_CASE("names_and_comments_that_are_not_utf8_do_not_keep_a_model_from_gltf") {
  const test::TemporaryFolder folder;
  const ReadResult latin =
      test::read_kept("# caf\xE9\no b\xF6x\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl r\xF6t\nf 1 2 3\n", "obj");
  for (const char* name : {"a.glb", "a.gltf"}) {
    const Content content{latin.surface, latin.surface.positions, latin.comments, latin.attributes.get()};
    mesh::write(folder / name, content, nullptr, {});
    CHECK(mesh::read(folder / name).attributes->materials.at(0).name == "r\xEF\xBF\xBDt");
  }
}

TEST_CASE("what_off_and_stl_cannot_hold_is_said") {
  Converted c;
  CHECK(c.to("out.off").size() == 5);
  CHECK(mesh::read(c / "out.off").attributes->colors == c.read.attributes->colors);
  c.moved.clear();
  const auto notes = c.to("out.stl");
  REQUIRE(notes.size() == 6);
  CHECK(notes[0] == "STL has no texture coordinates: 4 left out");
  CHECK(mesh::read(c / "out.stl").surface.triangles.size() == 2);
}
