#include "formats/attributes.h"

#include "formats/write.h"
#include "support/gltf.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::formats;
using namespace viete::mesh;
using viete::test::mentions;

namespace {

namespace fs = std::filesystem;
using Notes = std::vector<std::string>;

// A square of two triangles with all attributes. Vertex 1 has two different texture points.
const std::string everything =
    "mtllib some.mtl\no thing\ng part\nusemtl red\n"
    "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\ns off\n"
    "f 1/1/1 2/2/1 3/3/1\nusemtl blue\nf 1/4/1 3/3/1 4/4/1\n";

// Writes in the format of `path`. Uses the original file only if `with_original` is true.
Notes convert(const ReadResult& read, const fs::path& path, bool with_original = false) {
  const Content content{read.surface, read.surface.positions, {}, read.attributes.get()};
  return formats::write(path, content, with_original ? read.original.get() : nullptr, {});
}

struct Converted : test::TemporaryFolder {
  ReadResult read = [this] {
    test::put_file(*this / "some.mtl", "newmtl red\nKd 1 0 0\nmap_Kd red.png\nnewmtl blue\nKd 0 0 1\n");
    test::put_file(*this / "red.png", "a picture");
    return test::read_kept(everything, "obj", path());
  }();

  // Writes the surface, rotated by 90 degrees about the x axis.
  Notes to(const std::string& name) {
    moved.clear();
    for (const Point& p : read.surface.positions) moved.push_back({p[0], -p[2], p[1]});
    return formats::write(*this / name, Content{read.surface, moved, {}, read.attributes.get()}, nullptr, {});
  }
  std::vector<Point> moved;
};

}  // namespace

TEST_CASE("conversion_keeps_texture_points_normals_colours_groups_and_materials") {
  Converted c;
  CHECK(c.to("out.obj").empty());
  CHECK(c.entries() == 4);
  const ReadResult out = formats::read(c / "out.obj");
  CHECK(out.surface.positions == c.moved);
  REQUIRE(out.attributes);
  const Attributes &now = *out.attributes, &before = *c.read.attributes;
  CHECK(now.texture_points == before.texture_points);
  CHECK(now.corner_texture == before.corner_texture);
  CHECK(now.colors == before.colors);
  REQUIRE(now.groups.size() == before.groups.size());
  for (std::size_t g = 0; g < now.groups.size(); ++g) {
    CHECK(now.groups[g].first_polygon == before.groups[g].first_polygon);
    CHECK(now.groups[g].object == "thing");
    CHECK(now.groups[g].name == "part");
    CHECK(!now.groups[g].smooth);
    CHECK(now.materials[now.groups[g].material].name == before.materials[before.groups[g].material].name);
  }
  for (const std::uint32_t n : now.corner_normal) CHECK(norm(now.normals[n] - Vec3{0, -1, 0}) < 1e-12);
}

TEST_CASE("ply_stores_attributes_with_one_value_per_vertex") {
  Converted c;
  CHECK(c.to("out.ply") == Notes{"left out of the PLY file: several normals of a vertex, "
                                 "objects, groups, materials"});
  const ReadResult out = formats::read(c / "out.ply");
  CHECK(out.surface.positions == c.moved);
  CHECK(out.attributes->colors == c.read.attributes->colors);
  const ReadResult smooth =
      test::read_kept("v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0.5 0.25\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n", "obj");
  CHECK(convert(smooth, c / "smooth.ply").empty());
  const ReadResult again = formats::read(c / "smooth.ply");
  CHECK(again.attributes->normals[2] == Vec3{0, 0, 1});
  CHECK(again.attributes->texture_points[1] == Vec2{0.5, 0.25});
}

TEST_CASE("conversion_reports_content_that_is_lost") {
  Converted c;
  CHECK(c.to("out.off").size() == 1);
  CHECK(formats::read(c / "out.off").attributes->colors == c.read.attributes->colors);
  CHECK(c.to("out.stl") == Notes{"left out of the STL file: texture coordinates, normals, "
                                 "colours, objects, groups, materials, textures"});
  CHECK(formats::read(c / "out.stl").surface.triangles.size() == 2);
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const ReadResult obj = test::read_kept(triangle + "l 1 2\nl 2 3\np 1\nlod 3\n", "obj");
  CHECK(convert(obj, c / "a.stl", true) == Notes{"left out of the STL file: 2 lines, 1 "
                                                 "point, 1 statement of curves, surfaces and display"});
  CHECK(convert(obj, c / "a.obj", true).empty());
  CHECK(convert(test::read_kept(triangle, "obj"), c / "b.stl", true).empty());
  const ReadResult ply = test::read_kept(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
      "z\nproperty float "
      "quality\nelement edge 1\nproperty int vertex1\nend_header\n1 2 3 4\n0\n",
      "ply");
  CHECK(convert(ply, c / "a.off", true) ==
        Notes{"left out of the OFF file: property quality of vertex, element edge"});
  test::GltfParts parts = test::patch();
  parts.json["animations"] = {{{"channels", test::GltfJson::array()}}};
  parts.primitive()["targets"] = {{{"POSITION", 0}}};
  parts.primitive()["attributes"]["TEXCOORD_1"] = 2;
  CHECK(mentions(convert(test::read_kept(parts.glb(), "glb"), c / "a.ply", true).at(0),
                 "materials, animations, morph targets, second texture coordinates"));
}

TEST_CASE("conversion_names_comments_headers_attributes_extras_and_extensions") {
  const test::TemporaryFolder folder;
  const auto left_out = [&](const std::string& bytes, const std::string& extension, const char* name) {
    const auto notes = convert(test::read_kept(bytes, extension), folder / name, true);
    return notes.empty() ? "" : notes[0].substr(notes[0].find(": ") + 2);
  };
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\ns 1\nf 1 2 3\n";
  CHECK(left_out("# by hand\n" + triangle, "obj", "a.ply") == "smoothing groups, comments");
  const std::string head = "ply\nformat ascii 1.0\n",
                    rest =
                        "element vertex 1\nproperty float x\nproperty float "
                        "y\nproperty float z\nend_header\n1 2 3\n";
  CHECK(left_out(head + "comment by hand\nobj_info 7\n" + rest, "ply", "a.off") == "comments, obj_info");
  CHECK(left_out(head + rest, "ply", "a.off").empty());
  CHECK(left_out("OFF\n3 1 0\n0 0 0\n1 0 0 # corner\n0 1 0\n3 0 1 2\n", "off", "a.obj") == "comments");
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid\n";
  CHECK(left_out("solid part 7\n" + facet, "stl", "a.obj") == "name of the solid");
  CHECK(left_out("solid\n" + facet, "stl", "a.obj").empty());
  std::string binary(84 + 50, '\0');
  binary[80] = 1;
  binary[84 + 24] = binary[84 + 40] = '\x40';
  CHECK(left_out(binary, "stl", "a.obj").empty());
  binary[0] = 'x';
  binary[84 + 48] = 1;
  CHECK(left_out(binary, "stl", "a.obj") == "header, attributes of triangles");
  test::GltfParts parts = test::patch();
  parts.json["asset"]["copyright"] = "someone";
  parts.json["extensionsUsed"] = {"KHR_texture_transform", "EXT_other"};
  CHECK(mentions(left_out(parts.glb(), "glb", "a.obj"), "copyright, extras, extension EXT_other"));
  CHECK(left_out("COFF\n3 1 0\n0 0 0 9 9 9\n1 0 0 9 9 9\n0 1 0 9 9 9\n3 0 1 2 255 0 0\n", "off", "a.glb") ==
        "colours of faces");
}

TEST_CASE("gltf_stores_a_mesh_of_triangles_for_each_object_and_comments_that_are_not_utf8") {
  const test::TemporaryFolder folder;
  const ReadResult square = test::read_kept(
      "# caf\xE9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\no one\nf 1 2 3 4\no two\nf 4 3 2 1\n", "obj");
  for (const char* name : {"a.glb", "a.gltf"}) {
    const Content content{square.surface, square.surface.positions, square.comments, square.attributes.get()};
    CHECK(formats::write(folder / name, content, nullptr, {}) ==
          Notes{"2 faces of more than three corners became triangles"});
    const ReadResult read = formats::read(folder / name);
    CHECK(read.surface.positions.size() == 8);
    CHECK(read.attributes->groups.at(1).object == "two");
  }
}

TEST_CASE("shared_obj_normals_are_split_in_a_deformed_glb") {
  // A strip of two quads in the plane z = 0. All corners use one normal. Then the strip is bent at x = 1.
  const ReadResult flat = test::read_kept(
      "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nvn 0 0 1\nf 1//1 2//1 5//1 4//1\n"
      "f 2//1 3//1 6//1 5//1\n",
      "obj");
  std::vector<Point> posed = flat.surface.positions;
  posed[2][2] = posed[5][2] = 1;
  const test::TemporaryFolder folder;
  formats::write(folder / "a.glb", Content{flat.surface, posed, {}, flat.attributes.get()}, nullptr, {});
  const ReadResult read = formats::read(folder / "a.glb");
  const Attributes& a = *read.attributes;
  const double s = std::sqrt(0.5);
  for (std::size_t c = 0; c < read.surface.corners.size(); ++c) {
    const double x = read.surface.positions[read.surface.corners[c]][0];
    const Vec3& n = a.normals[a.corner_normal[c]];
    if (x == 0) CHECK(norm(n - Vec3{0, 0, 1}) < 1e-6);
    if (x == 2) CHECK(norm(n - Vec3{-s, 0, s}) < 1e-6);
    if (x == 1) CHECK((n[0] < -0.1 && n[0] > -s));
  }
}

TEST_CASE("obj_and_ply_saved_elsewhere_find_their_materials_and_images") {
  const std::string textured =
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl paint\nf 1/1 2/2 3/3\n";
  const test::TemporaryFolder folder;
  for (const char* name : {"in", "in/textures", "out"}) fs::create_directory(folder / name);
  test::put_file(folder / "in/a.obj", textured);
  test::put_file(folder / "in/a.mtl",
                 "newmtl paint\nmap_Kd textures\\wood.png\nmap_Bump -bm 0.2 bumps.png\nnorm "
                 "../far.png\nmap_Ks none.png\n");
  test::put_file(folder / "in/textures/wood.png", "wood");
  test::put_file(folder / "in/bumps.png", "bumps");
  test::put_file(folder / "far.png", "far");
  test::put_file(folder / "out/bumps.png", "mine");
  const auto again = [&](const char* from, const char* to) {
    return convert(formats::read(folder / from), folder / to, true);
  };
  for (int i = 0; i < 2; ++i) {
    const auto notes = again("in/a.obj", "out/b.obj");
    REQUIRE(notes.size() == 3);
    CHECK(mentions(notes[0], "a.mtl, textures/wood.png"));
    CHECK(mentions(notes[1], "bumps.png"));
    CHECK(mentions(notes[2], "far.png"));
  }
  CHECK(test::file_bytes(folder / "out/b.obj") == textured);
  CHECK(test::file_bytes(folder / "out/textures/wood.png") == "wood");
  CHECK(test::file_bytes(folder / "out/bumps.png") == "mine");
  CHECK(formats::read(folder / "out/b.obj").attributes->images.at(0).path ==
        folder / "out/textures/wood.png");
  for (const char* name : {"nowhere/b.obj", "nowhere/b.ply"})
    CHECK_THROWS_AS(again("in/a.obj", name), base::Error);
  CHECK_FALSE(fs::exists(folder / "nowhere"));
  CHECK(again("in/a.obj", "in/b.obj").empty());
  fs::create_directory(folder / "new");
  CHECK(mentions(again("out/../in/a.obj", "new/b.obj").at(0), "a.mtl, bumps.png, textures/wood.png"));
  test::put_file(
      folder / "in/a.ply",
      "ply\nformat ascii 1.0\ncomment TextureFile bumps.png\nelement vertex 3\nproperty float x\nproperty "
      "float y\nproperty float z\nproperty float s\nproperty float t\nelement face 1\nproperty list uchar "
      "int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
  fs::create_directory(folder / "ply");
  CHECK(again("in/a.ply", "ply/b.ply").size() == 1);
  CHECK(test::file_bytes(folder / "ply/bumps.png") == "bumps");
}
