#include "formats/materials.h"

#include "base/encoding.h"
#include "base/picture.h"
#include "formats/write.h"
#include "gltf_judge.h"
#include "support/gltf.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::formats;
using viete::test::mentions;

namespace {

namespace fs = std::filesystem;
using Notes = std::vector<std::string>;

std::string png(std::vector<std::uint8_t> rgba, int width = 1) {
  const int height = static_cast<int>(rgba.size()) / 4 / width;
  return base::encode_png("test", {width, height, std::move(rgba)});
}

// An uncompressed TGA of one red pixel.
std::string tga() {
  std::string bytes(18, '\0');
  bytes[2] = 2;
  bytes[12] = bytes[14] = 1;
  bytes[16] = 24;
  return bytes + std::string("\0\0\xFF", 3);
}

const std::string two_faces =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "o body\nusemtl paint\nf 1/1 2/2 3/3\no lamp\nusemtl light\nf 1/1 3/3 4/4\n";
const std::string library =
    "newmtl paint\nKd 1 0.5 0.25\nd 0.5\nPm 0.75\nPr 0.25\nmap_Kd wood.png\nmap_d wood.png\n"
    "map_Bump -bm 1 normals.png\nmap_Pm -imfchan b surface.png\nmap_Pr -imfchan g surface.png\n"
    "newmtl light\nKd 0 0 0\nKe 1 0.5 0\nmap_Ke glow.png\n";

// A model with all properties of materials in `in/a.obj`, and an empty folder `out`.
struct Painted : test::TemporaryFolder {
  Painted() {
    for (const char* name : {"in", "out"}) fs::create_directory(*this / name);
    test::put_file(*this / "in/a.obj", two_faces);
    test::put_file(*this / "in/a.mtl", library);
    test::put_file(*this / "in/wood.png", png({200, 100, 50, 128}));
    test::put_file(*this / "in/normals.png", png({128, 128, 255, 255}));
    test::put_file(*this / "in/surface.png", png({255, 10, 20, 255}));
    test::put_file(*this / "in/glow.png", png({255, 255, 0, 255}));
  }

  Notes convert(const std::string& from, const std::string& to) {
    const ReadResult read = formats::read(*this / from);
    const Content content{read.surface, read.surface.positions, {}, read.attributes.get()};
    return formats::write(*this / to, content, read.original.get(), {});
  }
  std::ptrdiff_t files_in_out() const { return std::distance(fs::directory_iterator(*this / "out"), {}); }
  Attributes attributes(const std::string& name) { return *formats::read(*this / name).attributes; }
};

std::string bytes_of(const ImageFile& image) {
  return image.bytes ? *image.bytes : test::file_bytes(image.path);
}

void check_same(const Attributes& a, const Attributes& b) {
  REQUIRE(a.materials.size() == b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    const Material &x = a.materials[i], &y = b.materials[i];
    CHECK(x.name == y.name);
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(x.base_color[k] == doctest::Approx(y.base_color[k]).epsilon(1e-6));
      CHECK(x.emission[k] == doctest::Approx(y.emission[k]).epsilon(1e-6));
    }
    CHECK(x.metallic == y.metallic);
    CHECK(x.roughness == y.roughness);
    CHECK(x.is_translucent == y.is_translucent);
    for (const MaterialImage& property : material_images) {
      CAPTURE(property.name);
      REQUIRE((x.*property.image == mesh::none) == (y.*property.image == mesh::none));
      if (x.*property.image == mesh::none) continue;
      CHECK(bytes_of(a.images[x.*property.image]) == bytes_of(b.images[y.*property.image]));
    }
  }
}

}  // namespace

TEST_CASE("materials_and_images_survive_obj_to_gltf_to_obj") {
  Painted p;
  const Attributes before = p.attributes("in/a.obj");
  for (const std::string extension : {"glb", "gltf"}) {
    CHECK(p.convert("in/a.obj", "out/b." + extension).empty());
    check_same(p.attributes("out/b." + extension), before);
    CHECK(p.convert("out/b." + extension, "out/" + extension + ".obj").empty());
    const Attributes again = p.attributes("out/" + extension + ".obj");
    check_same(again, before);
    for (const ImageFile& image : again.images) CHECK(image.path.parent_path() == p / "out");
  }
  CHECK(p.files_in_out() == 2 + 4 + 4);  // models, OBJ files with libraries, images
}

TEST_CASE("gltf_materials_have_linear_colours_and_one_primitive_each") {
  Painted p;
  std::string one_object = two_faces;
  one_object.erase(one_object.find("o lamp\n"), 7);
  test::put_file(p / "in/a.obj", one_object);
  p.convert("in/a.obj", "out/b.glb");
  const test::GltfJudge judge(p / "out/b.glb");
  const auto& primitives = judge.model.meshes.at(0).primitives;
  REQUIRE(primitives.size() == 2);
  const auto& paint = judge.model.materials.at(static_cast<std::size_t>(primitives[0].material));
  CHECK(paint.name == "paint");
  CHECK(paint.alphaMode == "BLEND");
  CHECK(paint.doubleSided);
  CHECK(paint.pbrMetallicRoughness.baseColorFactor[1] == doctest::Approx(0.2140411));  // 0.5 in sRGB
  CHECK(paint.pbrMetallicRoughness.baseColorFactor[3] == 0.5);
  CHECK(paint.pbrMetallicRoughness.metallicFactor == 0.75);
  CHECK(paint.pbrMetallicRoughness.metallicRoughnessTexture.index >= 0);
  CHECK(paint.normalTexture.index >= 0);
  const auto& light = judge.model.materials.at(static_cast<std::size_t>(primitives[1].material));
  CHECK(light.alphaMode == "OPAQUE");
  CHECK(light.emissiveFactor[1] == doctest::Approx(0.2140411));
  CHECK(judge.model.images.size() == 4);
  CHECK(judge.model.accessors.at(static_cast<std::size_t>(primitives[1].indices)).count == 3);
}

TEST_CASE("images_beside_a_new_obj_never_replace_other_files") {
  Painted p;
  p.convert("in/a.obj", "out/b.glb");
  test::put_file(p / "out/wood.png", "mine");
  test::put_file(p / "out/c.mtl", "mine");
  for (int i = 0; i < 2; ++i) p.convert("out/b.glb", "out/c.obj");
  CHECK(test::file_bytes(p / "out/wood.png") == "mine");
  CHECK(test::file_bytes(p / "out/c.mtl") == "mine");
  CHECK(test::file_bytes(p / "out/wood-2.png") == test::file_bytes(p / "in/wood.png"));
  CHECK(p.files_in_out() == 3 + 2 + 4);
  check_same(p.attributes("out/c.obj"), p.attributes("in/a.obj"));
}

TEST_CASE("a_disk_that_is_full_of_images_is_an_error_and_leaves_no_files") {
  Painted p;
  test::put_file(p / "in/wood.png", png(std::vector<std::uint8_t>(4, 7)) + std::string(5000, 'x'));
  test::put_file(p / "out/a.ply", "old");
  {
    const test::FullDisk room_for_the_model_alone(2000);
    CHECK_THROWS_AS(p.convert("in/a.obj", "out/a.ply"), base::Error);
  }
  CHECK(test::file_bytes(p / "out/a.ply") == "old");
  CHECK(p.files_in_out() == 1);
}

TEST_CASE("frames_of_an_animation_share_a_library") {
  Painted p;
  p.convert("in/a.obj", "b.glb");
  for (const char* frame : {"out/frame_0001.obj", "out/frame_0002.obj", "out/2026.obj"})
    p.convert("b.glb", frame);
  CHECK(fs::exists(p / "out/frame.mtl"));
  CHECK(fs::exists(p / "out/2026.mtl"));
  CHECK(p.files_in_out() == 3 + 2 + 4);
  CHECK(p.attributes("out/frame_0002.obj").materials.at(0).name == "paint");
}

TEST_CASE("separate_metallic_and_roughness_images_are_combined_for_gltf") {
  Painted p;
  test::put_file(p / "in/rough.png", png({40, 40, 40, 255, 80, 80, 80, 255}, 2));
  test::put_file(p / "in/a.mtl",
                 "newmtl paint\nmap_Pr rough.png\nmap_Pm surface.png\nnewmtl light\nmap_Pr rough.png\n");
  p.convert("in/a.obj", "out/b.glb");
  const Attributes a = p.attributes("out/b.glb");
  REQUIRE(a.materials.size() == 2);
  const auto pixel = [&](std::size_t material, int x) {
    return base::decode_picture("", *a.images.at(a.materials[material].roughness_image).bytes).pixel(x, 0);
  };
  CHECK(a.materials[0].metallic_image == a.materials[0].roughness_image);
  CHECK(pixel(0, 0) == std::array<std::uint8_t, 4>{255, 40, 20, 255});
  CHECK(pixel(0, 1) == std::array<std::uint8_t, 4>{255, 80, 20, 255});
  CHECK(pixel(1, 1) == std::array<std::uint8_t, 4>{255, 80, 255, 255});
}

TEST_CASE("images_that_gltf_cannot_store_are_converted_or_named") {
  Painted p;
  test::put_file(p / "in/wood.png", tga());
  test::put_file(p / "in/normals.png", png({90, 90, 90, 255}));
  test::put_file(p / "in/surface.png", "no picture");
  fs::remove(p / "in/glow.png");
  const Notes notes = p.convert("in/a.obj", "out/b.glb");
  REQUIRE(notes.size() == 3);
  CHECK(mentions(notes[0], "surface.png"));
  CHECK(mentions(notes[1], "glow.png"));
  CHECK(mentions(notes[2], "heights instead of normals"));
  const Attributes a = p.attributes("out/b.glb");
  REQUIRE(a.images.size() == 1);
  CHECK(base::decode_picture("", *a.images[0].bytes).pixel(0, 0)[0] == 255);
  CHECK(a.materials[0].normal_image == mesh::none);
}

TEST_CASE("hostile_names_of_images_stay_in_the_folder") {
  Painted p;
  test::GltfParts parts = test::patch();
  const std::string picture = png({1, 2, 3, 255});
  parts.json["images"] = test::GltfJson::array();
  const auto add = [&](const std::string& name, const std::string& bytes) {
    parts.json["images"].push_back({{"name", name}, {"uri", "data:image/png;base64," + base::base64(bytes)}});
  };
  for (const char* name : {"../../evil", "..", "a/b\\c:d", "", "same", "same", ".x.desktop"})
    add(name, picture);
  add(".profile", "#!/bin/sh\n");
  parts.json["textures"] = test::GltfJson::array();
  for (int i = 0; i < 8; ++i) {
    parts.json["textures"].push_back({{"source", i}});
    parts.json["materials"][static_cast<std::size_t>(i)] = {{"name", "#m\n\\"},
                                                            {"emissiveTexture", {{"index", i}}}};
  }
  test::put_file(p / "in/c.glb", parts.glb());
  const Notes notes = p.convert("in/c.glb", "out/c.obj");
  REQUIRE(!notes.empty());
  CHECK_MESSAGE(mentions(notes.back(), ".profile: this is not an image"), notes.back());
  for (const auto& entry : fs::directory_iterator(p.path()))
    CHECK((entry.path() == p / "in" || entry.path() == p / "out"));
  CHECK(fs::exists(p / "out/evil.png"));
  CHECK(fs::exists(p / "out/same.png"));
  CHECK(!fs::exists(p / "out/same-2.png"));
  CHECK(fs::exists(p / "out/.x.desktop.png"));
  CHECK(!fs::exists(p / "out/.profile"));
  const auto names = test::file_bytes(p / "out/c.mtl");
  CHECK(mentions(names, "newmtl _m\n"));
  CHECK(mentions(names, "newmtl _m-8\n"));
}

TEST_CASE("only_images_are_copied") {
  Painted p;
  test::put_file(p / "in/a.mtl", "newmtl paint\nmap_Kd ../secret.txt\nnewmtl light\nmap_Kd wood.png\n");
  test::put_file(p / "secret.txt", "password");
  const Notes notes = p.convert("in/a.obj", "out/a.ply");
  REQUIRE(!notes.empty());
  CHECK(mentions(notes.back(), "secret.txt: this is not an image"));
  CHECK(p.files_in_out() == 2);
}

TEST_CASE("names_that_libraries_cannot_contain_are_replaced") {
  Painted p;
  test::GltfParts parts = test::patch();
  parts.json["images"] = {{{"uri", "h%23\n.png"}}};
  parts.json["textures"] = {{{"source", 0}}};
  parts.json["materials"] = {{{"name", "m"}, {"emissiveTexture", {{"index", 0}}}}};
  parts.json["nodes"][0]["name"] = "a#";
  parts.primitive()["material"] = 0;
  test::put_file(p / "out/c.glb", parts.glb());
  test::put_file(p / "out/h#\n.png", png({1, 2, 3, 255}));
  p.convert("out/c.glb", "out/c#.obj");
  const Attributes a = p.attributes("out/c#.obj");
  REQUIRE(a.images.size() == 1);
  CHECK(a.images[0].path == p / "out/h__.png");
  CHECK(fs::exists(a.images[0].path));
  CHECK(a.groups.at(0).object == "a_");
}

// With the square of the number of materials, this would take minutes.
TEST_CASE("many_materials_with_the_same_name_are_numbered") {
  Attributes a;
  a.materials.resize(200'000);
  a.materials[1].name = "material-2";
  complete_materials(a);
  CHECK(a.materials[1].name == "material-2");
  CHECK(a.materials[2].name == "material-3");
  CHECK(a.materials.back().name == "material-200000");
}

TEST_CASE("colours_of_faces_become_materials_of_obj_and_the_reverse") {
  Painted p;
  test::put_file(p / "in/a.off",
                 "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 3 0 0 255 128\n");
  CHECK(p.convert("in/a.off", "out/a.obj") == Notes{"the colours of faces became materials"});
  const Attributes a = p.attributes("out/a.obj");
  REQUIRE(a.groups.size() == 2);
  CHECK(a.materials[a.groups[0].material].base_color == Color{1, 0, 0, 1});
  CHECK(a.materials[a.groups[1].material].base_color[3] == doctest::Approx(128 / 255.0));
  CHECK(p.convert("out/a.obj", "out/b.off") ==
        Notes{"the colours of materials became colours of faces", "left out of the OFF file: materials"});
  CHECK(p.attributes("out/b.off").polygon_colors == p.attributes("in/a.off").polygon_colors);
}

TEST_CASE("ply_stores_the_images_of_faces") {
  Painted p;
  test::put_file(p / "in/a.mtl",
                 "newmtl paint\nmap_Kd wood.png\nnewmtl light\nmap_Kd glow.png\nmap_Ke glow.png\n");
  CHECK(p.convert("in/a.obj", "out/a.ply") ==
        Notes{"left out of the PLY file: objects, materials, emission textures"});
  const Attributes a = p.attributes("out/a.ply");
  REQUIRE(a.groups.size() == 2);
  for (const std::size_t face : {0, 1}) {
    const Material& m = a.materials.at(a.groups[face].material);
    CHECK(a.images.at(m.base_color_image).path == p / (face == 0 ? "out/wood.png" : "out/glow.png"));
  }
  CHECK(p.files_in_out() == 3);
}
