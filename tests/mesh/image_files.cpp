// Images of materials on their way from one format to another.
#include "mesh/formats/image_files.h"

#include <doctest/doctest.h>

#include "base/picture.h"
#include "mesh/formats/write.h"
#include "mesh/shapes.h"
#include "support/gltf.h"

using namespace viete;
using namespace viete::mesh;
using viete::test::holds;

namespace {

namespace fs = std::filesystem;

// A picture of 2 x 2 pixels.
std::string small_png(std::uint8_t red) {
  return base::encode_png("small", 2, 2, 3,
                          std::vector<std::uint8_t>{red, 0, 0, 0, 255, 0, 0, 0, 255, 9, 9, 9});
}

// The same without compression, bottom row first: blue, green, red.
std::string small_tga() {
  std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\x18\0", 18);
  return tga + std::string("\xFF\0\0\11\11\11\0\0\xC8\0\xFF\0", 12);
}

test::GltfParts textured(const std::string& image, const char* name = nullptr) {
  test::GltfParts parts = test::patch();
  parts.json["images"] = {
      {{"bufferView", parts.view(std::vector<char>(image.begin(), image.end()))}, {"mimeType", "image/png"}}};
  if (name) parts.json["images"][0]["name"] = name;
  return parts;
}

struct ImageFolder : test::TemporaryFolder {
  std::vector<std::string> convert(const std::string& from, const std::string& to) {
    const ReadResult read = mesh::read(*this / from);
    const Content content{read.surface, read.surface.positions, {}, read.attributes.get()};
    return mesh::write(*this / to, content, nullptr, {});
  }
  void put(const std::string& name, const test::GltfParts& parts) {
    test::put_file(*this / name, parts.glb());
  }
};

const std::string textured_triangle =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl paint\nf 1/1 2/2 3/3\n";

}  // namespace

TEST_CASE("a_glb_becomes_an_obj_with_its_images_beside_and_a_glb_again") {
  ImageFolder folder;
  const std::string png = small_png(200);
  folder.put("a.glb", textured(png));
  const auto notes = folder.convert("a.glb", "b.obj");
  REQUIRE(notes.size() == 2);
  CHECK(notes[0] == "1 image of the file is beside it now: paint.png");  // of the material that uses it
  CHECK(holds(notes[1], "b.mtl"));
  CHECK(test::file_bytes(folder / "paint.png") == png);
  CHECK(holds(test::file_bytes(folder / "b.mtl"), "map_Kd paint.png\n"));
  const ReadResult before = mesh::read(folder / "a.glb"), obj = mesh::read(folder / "b.obj");
  CHECK(obj.attributes->images.at(0).path == folder / "paint.png");
  CHECK(folder.convert("b.obj", "c.glb").empty());
  const ReadResult after = mesh::read(folder / "c.glb");
  const Attributes &a = *before.attributes, &b = *after.attributes;
  REQUIRE(before.surface.corners.size() == after.surface.corners.size());
  for (std::size_t c = 0; c < a.corner_texture.size(); ++c) {  // vertices come in another order
    const auto was = before.surface.corners[c], is = after.surface.corners[c];
    CHECK(before.surface.positions[was] == after.surface.positions[is]);
    CHECK(a.texture_points[a.corner_texture[c]] == b.texture_points[b.corner_texture[c]]);
    CHECK(a.normals[a.corner_normal[c]] == b.normals[b.corner_normal[c]]);
  }
  REQUIRE(b.images.size() == 1);
  CHECK(*b.images[0].bytes == png);
  CHECK(b.images[0].name == "paint");
  CHECK(b.materials.at(b.groups.at(0).material).base_color_image == 0);
}

TEST_CASE("an_image_beside_takes_the_place_of_no_other_file_and_comes_once") {
  ImageFolder folder;
  folder.put("a.glb", textured(small_png(200), "wood.png"));
  test::put_file(folder / "wood.png", "mine");
  for (int i = 0; i < 2; ++i) {
    CHECK(holds(folder.convert("a.glb", "b.obj").at(0), "wood-2.png"));
    CHECK(test::file_bytes(folder / "wood.png") == "mine");
    CHECK(test::file_bytes(folder / "wood-2.png") == small_png(200));
    CHECK(folder.entries() == 5);  // a.glb b.obj b.mtl and two images
  }
  folder.put("a.glb", textured(small_png(100), "wood.png"));
  CHECK(holds(folder.convert("a.glb", "b.obj").at(0), "wood-3.png"));
  CHECK(test::file_bytes(folder / "wood-2.png") == small_png(200));
}

TEST_CASE("names_of_images_lead_nowhere_else") {
  for (const auto& [name, file] :
       std::vector<std::pair<const char*, const char*>>{{"../../etc/passwd", "passwd.png"},
                                                        {"my  fine wood (1).PNG", "my_fine_wood_1.png"},
                                                        {"-clamp", "clamp.png"},
                                                        {"..", "b.png"},
                                                        {"/", "b.png"},
                                                        {"a\nnewmtl b", "a_newmtl_b.png"},
                                                        {"v1.2 of it", "v1.2_of_it.png"},
                                                        {".hidden#", "hidden.png"}}) {
    ImageFolder folder;
    fs::create_directory(folder / "in");
    folder.put("in/a.glb", textured(small_png(1), name));
    CHECK(holds(folder.convert("in/a.glb", "in/b.obj").at(0), file));
    CHECK(fs::exists(folder / "in" / file));
    CHECK(folder.entries() == 1);
    CHECK(mesh::read(folder / "in/b.obj").attributes->images.at(0).path == folder / "in" / file);
  }
}

TEST_CASE("what_gltf_cannot_take_becomes_png_and_what_is_missing_is_said") {
  ImageFolder folder;
  test::put_file(folder / "a.obj", textured_triangle);
  test::put_file(folder / "a.mtl", "newmtl paint\nmap_Kd a.tga\n");
  auto notes = folder.convert("a.obj", "missing.glb");
  REQUIRE(notes.size() == 1);
  CHECK(holds(notes[0], "a.tga"));
  CHECK(holds(notes[0], "the texture is left out"));
  CHECK(mesh::read(folder / "missing.glb").attributes->materials.at(0).base_color_image == none);
  test::put_file(folder / "a.tga", "RIFF....WEBPVP8 ");
  notes = folder.convert("a.obj", "webp.glb");
  REQUIRE(notes.size() == 1);
  CHECK(holds(notes[0], "not a picture that can be read here"));
  std::string huge = small_tga();
  huge.replace(12, 4, "\xff\xff\xff\xff");
  test::put_file(folder / "a.tga", huge);
  notes = folder.convert("a.obj", "huge.glb");
  REQUIRE(notes.size() == 1);
  CHECK(holds(notes[0], "65535 x 65535 pixels"));
  test::put_file(folder / "a.tga", small_tga());
  notes = folder.convert("a.obj", "good.gltf");
  REQUIRE(notes.size() == 1);
  CHECK(holds(notes[0], "became PNG"));
  const ReadResult good = mesh::read(folder / "good.gltf");
  CHECK(*good.attributes->images.at(0).bytes == small_png(200));
}

TEST_CASE("an_image_elsewhere_is_led_to_and_stays") {
  ImageFolder folder;
  for (const char* name : {"in", "out"}) fs::create_directory(folder / name);
  test::GltfParts parts = test::patch();
  parts.json["images"] = {{{"uri", "wood.png"}}};
  folder.put("in/a.glb", parts);
  test::put_file(folder / "in/wood.png", small_png(3));
  const auto notes = folder.convert("in/a.glb", "out/b.obj");
  CHECK(holds(notes.at(0), "1 image stayed where the model was read from, and b.obj leads there"));
  CHECK(holds(test::file_bytes(folder / "out/b.mtl"), "map_Kd ../in/wood.png\n"));
  CHECK(mesh::read(folder / "out/b.obj").attributes->images.at(0).path == folder / "in/wood.png");
  CHECK(folder.convert("in/a.glb", "in/b.obj").size() == 1);
}

TEST_CASE("materials_of_one_name_and_none_stay_apart_in_an_obj") {
  ImageFolder folder;
  test::GltfParts parts = test::patch();
  parts.json["materials"] = {{{"name", "m"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}}}},
                             {{"name", "m"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0, 1, 0, 1}}}}}};
  auto& primitives = parts.json["meshes"][0]["primitives"];
  primitives[0]["material"] = 0;
  primitives.push_back(primitives[0]);
  primitives[1]["material"] = 1;
  primitives.push_back(primitives[0]);
  primitives[2].erase("material");
  folder.put("a.glb", parts);
  folder.convert("a.glb", "b.obj");
  const ReadResult obj = mesh::read(folder / "b.obj");
  const Attributes& a = *obj.attributes;
  REQUIRE(a.groups.size() == 3);
  CHECK(a.materials.at(a.groups[0].material).base_color == Color{1, 0, 0, 1});
  CHECK(a.materials.at(a.groups[1].material).base_color == Color{0, 1, 0, 1});
  CHECK(a.materials.at(a.groups[2].material).name == "no_material");
  CHECK(a.materials.at(a.groups[2].material).base_color == Material{}.base_color);
}

TEST_CASE("an_obj_that_cannot_be_written_leaves_nothing_beside_it") {
  ImageFolder folder;
  folder.put("a.glb", textured(small_png(3)));
  fs::create_directories(folder / "b.obj" / "inside");
  CHECK_THROWS_AS(folder.convert("a.glb", "b.obj"), base::Error);
  CHECK(folder.entries() == 2);
}

TEST_CASE("an_image_of_a_kind_that_glTF_knows_by_extension_is_found") {
  ImageFolder folder;
  test::GltfParts parts = textured("RIFF....WEBPVP8 ", "cloth");
  parts.json["extensionsUsed"] = {"EXT_texture_webp"};
  parts.json["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
  folder.put("a.glb", parts);
  CHECK(holds(folder.convert("a.glb", "b.obj").at(0), "cloth.webp"));
}

TEST_CASE("other_textures_of_a_glb_are_said_to_be_left_out") {
  ImageFolder folder;
  test::GltfParts parts = textured(small_png(3));
  parts.json["images"].push_back({{"uri", "normals.png"}});
  folder.put("a.glb", parts);
  const auto notes = folder.convert("a.glb", "b.obj");
  CHECK(notes.at(0) == "OBJ has no images but those of base colours: 1 left out");
}

TEST_CASE("normals_of_an_obj_that_serve_several_vertices_are_apart_in_a_glb_that_is_deformed") {
  // A strip of two quads in the plane z = 0 with one normal for all, then bent up at x = 1.
  const ReadResult flat = test::read_kept(
      "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nvn 0 0 1\nf 1//1 2//1 5//1 4//1\nf 2//1 3//1 "
      "6//1 "
      "5//1\n",
      "obj");
  std::vector<Point> posed = flat.surface.positions;
  posed[2][2] = posed[5][2] = 1;
  const ImageFolder folder;
  mesh::write(folder / "a.glb", Content{flat.surface, posed, {}, flat.attributes.get()}, nullptr, {});
  const ReadResult read = mesh::read(folder / "a.glb");
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

TEST_CASE("an_obj_or_ply_that_is_written_again_elsewhere_finds_its_materials_and_images") {
  const ImageFolder folder;
  for (const char* name : {"in", "in/textures", "out"}) fs::create_directory(folder / name);
  test::put_file(folder / "in/a.obj", textured_triangle);
  test::put_file(folder / "in/a.mtl",
                 "newmtl paint\nmap_Kd textures\\wood.png\nmap_Bump -bm 0.2 bumps.png\nnorm "
                 "../far.png\nmap_Ks none.png\n");
  test::put_file(folder / "in/textures/wood.png", small_png(1));
  test::put_file(folder / "in/bumps.png", small_png(2));
  test::put_file(folder / "far.png", small_png(3));
  test::put_file(folder / "out/bumps.png", "mine");
  const auto again = [&](const char* from, const char* to) {
    const ReadResult read = mesh::read(folder / from);
    const Content content{read.surface, read.surface.positions, {}, read.attributes.get()};
    return mesh::write(folder / to, content, read.original.get(), {});
  };
  for (int i = 0; i < 2; ++i) {
    const auto notes = again("in/a.obj", "out/b.obj");
    REQUIRE(notes.size() == 3);
    CHECK(holds(notes[0], "a.mtl, textures/wood.png"));
    CHECK(holds(notes[1], "bumps.png"));
    CHECK(holds(notes[2], "far.png"));
  }
  CHECK(test::file_bytes(folder / "out/b.obj") == textured_triangle);
  CHECK(test::file_bytes(folder / "out/textures/wood.png") == small_png(1));
  CHECK(test::file_bytes(folder / "out/bumps.png") == "mine");
  CHECK(mesh::read(folder / "out/b.obj").attributes->images.at(0).path == folder / "out/textures/wood.png");
  CHECK(again("in/a.obj", "in/b.obj").empty());
  test::put_file(
      folder / "in/a.ply",
      "ply\nformat ascii 1.0\ncomment TextureFile bumps.png\nelement vertex 3\nproperty float x\nproperty "
      "float y\nproperty float z\nproperty float s\nproperty float t\nelement face 1\nproperty list uchar "
      "int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
  fs::create_directory(folder / "ply");
  CHECK(again("in/a.ply", "ply/b.ply").size() == 1);
  CHECK(test::file_bytes(folder / "ply/bumps.png") == small_png(2));
}
