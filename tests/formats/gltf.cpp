#include "formats/codecs.h"

#include "formats/gltf_judge.h"
#include "formats/write.h"
#include "support/distance.h"
#include "support/far.h"
#include "support/gltf.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::formats;
using namespace viete::mesh;
using test::GltfJson;
using test::GltfParts;
using test::mentions, test::largest_distance, test::raised;

namespace {

ReadResult read_parts(const GltfParts& parts) {
  return test::read_text(parts.glb(), "glb");
}

std::string refusal_of(const GltfParts& parts) {
  const std::string said = test::refusal(parts.glb(), "glb");
  CHECK(test::refusal(parts.text(), "gltf") != "");
  return said;
}

std::vector<float> floats_by_judge(const std::filesystem::path& path, int accessor) {
  return test::GltfJudge(path).floats(accessor);
}

int accessor_of(const std::string& glb, std::size_t mesh, const char* attribute) {
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, 4);
  return GltfJson::parse(glb.substr(20, size))["meshes"][mesh]["primitives"][0]["attributes"][attribute];
}

std::vector<std::string> rewrite(const ReadResult& r, const std::filesystem::path& to,
                                 const std::vector<Point>& positions) {
  return r.original->write_file(to, {r.surface, positions, {}}, {}, nullptr);
}

}  // namespace

TEST_CASE("glb_and_gltf_read_the_same_and_seams_are_welded") {
  const GltfParts parts = test::patch();
  for (const ReadResult& r :
       {read_parts(parts), test::read_text(parts.text(), "gltf"), test::read_text(parts.glb(), "obj")}) {
    test::check_invariants(r.surface);
    CHECK(r.surface.positions ==
          std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}});
    CHECK(r.surface.triangles == std::vector<Triangle>{{0, 1, 3}, {0, 3, 2}, {1, 4, 5}, {1, 5, 3}});
    REQUIRE(r.attributes);
    const Attributes& a = *r.attributes;
    CHECK(a.texture_points[a.corner_texture[1]] == Vec2{1, 0});  // v increases upward
    CHECK(a.texture_points[a.corner_texture[6]] == Vec2{0, 0});  // the same vertex, other side of the seam
    CHECK(a.normals[a.corner_normal[0]] == Vec3{0, 0, 1});
    REQUIRE(a.groups.size() == 1);
    CHECK(a.groups[0].object == "only");
    CHECK(a.materials.at(a.groups[0].material).name == "paint");
    REQUIRE(a.images.size() == 1);
    CHECK(a.images[0].bytes->substr(1, 3) == "PNG");
  }
}

TEST_CASE("nodes_place_their_meshes") {
  GltfParts parts = test::patch();
  parts.json["nodes"] = {
      {{"children", {1}}, {"translation", {10, 0, 0}}},
      {{"mesh", 0}, {"rotation", {0, 0, 0.7071067811865476, 0.7071067811865476}}, {"scale", {-2, 1, 1}}}};
  const ReadResult r = read_parts(parts);
  CHECK(norm(r.surface.positions[4] - Point{10, -4, 0}) < 1e-12);
  CHECK(r.surface.triangles[0] == Triangle{0, 3, 1});  // the mirrored node reverses the orientation
  CHECK(norm(r.attributes->normals[0] - Vec3{0, 0, 1}) < 1e-12);
}

TEST_CASE("strips_fans_sparse_and_short_numbers_are_read") {
  GltfParts parts = test::patch();
  auto& primitive = parts.primitive();
  primitive["indices"] = parts.accessor(std::vector<std::uint8_t>{0, 1, 2, 3, 3, 4}, 5121, "SCALAR", 1);
  primitive["mode"] = 5;
  CHECK(read_parts(parts).surface.triangles == std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}});
  primitive["mode"] = 6;
  CHECK(read_parts(parts).surface.triangles.size() == 3);
  primitive["mode"] = 1;
  const ReadResult lines = read_parts(parts);
  CHECK(lines.surface.triangles.empty());
  CHECK(lines.surface.positions.size() == 6);
  REQUIRE(lines.warnings.size() == 2);
  CHECK(mentions(lines.warnings[0], "1 primitive of points or lines: deformed"));
  primitive["mode"] = 4;
  const std::size_t where = parts.view(std::vector<std::uint16_t>{1});
  const std::size_t what = parts.view(std::vector<float>{1, 0, 7});
  parts.json["accessors"][0]["sparse"] = {{"count", 1},
                                          {"indices", {{"bufferView", where}, {"componentType", 5123}}},
                                          {"values", {{"bufferView", what}}}};
  CHECK(read_parts(parts).surface.positions[1] == Point{1, 0, 7});
}

TEST_CASE("unmoved_gltf_keeps_every_byte_and_key") {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.glb", "a.gltf"}) {
    GltfParts parts = test::patch();
    parts.json["extensionsUsed"] = {"VENDOR_thing"};
    parts.json["extensions"] = {{"VENDOR_thing", {{"deep", {1, 2.5, "three"}}}}};
    const bool binary = std::string(name) == "a.glb";
    const ReadResult r = test::put_and_read(folder / name, binary ? parts.glb() : parts.text());
    r.original->write_file(folder / (std::string("out-") + name), {r.surface, r.surface.positions, {}}, {},
                           nullptr);
    const std::string out = test::file_bytes(folder / (std::string("out-") + name));
    if (binary) {
      CHECK(out == parts.glb());
    } else {
      CHECK(GltfJson::parse(out) == GltfJson::parse(parts.text()));
    }
  }
}

TEST_CASE("deformed_gltf_differs_only_in_positions_and_normals") {
  const test::TemporaryFolder folder;
  const GltfParts parts = test::patch();
  const ReadResult r = test::put_and_read(folder / "a.glb", parts.glb());
  const auto posed = raised(r.surface, 0.25);
  CHECK(rewrite(r, folder / "b.glb", posed).empty());
  const std::string out = test::file_bytes(folder / "b.glb");
  CHECK(out.substr(out.size() - 70) ==
        parts.glb().substr(parts.glb().size() - 70));  // texture points, indices, image
  const auto positions = floats_by_judge(folder / "b.glb", 0), normals = floats_by_judge(folder / "b.glb", 1);
  for (std::size_t i = 0; i < 8; ++i)
    CHECK(positions[3 * i + 2] == 0.25F * positions[3 * i] * positions[3 * i]);
  CHECK(normals[0] == doctest::Approx(-0.25 / std::hypot(1, 0.25)));             // normal of the left quad
  CHECK(normals[15] == doctest::Approx(-0.75 / std::hypot(1, 0.75)));            // normal of the right quad
  for (std::size_t k = 0; k < 3; ++k) CHECK(normals[3 + k] == normals[12 + k]);  // on both sides of the seam
  CHECK(floats_by_judge(folder / "b.glb", 2) == floats_by_judge(folder / "a.glb", 2));
  const ReadResult again = read(folder / "b.glb");
  CHECK(again.surface.positions == posed);
}

TEST_CASE("instances_that_deform_differently_become_separate_meshes") {
  const test::TemporaryFolder folder;
  GltfParts parts = test::patch();
  parts.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {5, 0, 0}}, {"scale", {2, 2, 2}}}};
  parts.json["scenes"] = {{{"nodes", {0, 1}}}};
  const ReadResult r = test::put_and_read(folder / "a.glb", parts.glb());
  REQUIRE(r.surface.positions.size() == 12);
  const auto posed = raised(r.surface, 0.125);
  const auto notes = rewrite(r, folder / "b.glb", posed);
  REQUIRE(notes.size() == 1);
  CHECK(mentions(notes[0], "shared meshes were copied 1 time"));
  const ReadResult again = read(folder / "b.glb");
  CHECK(largest_distance(again.surface.positions, posed) < 1e-6);
}

TEST_CASE("shared_or_non_float_positions_get_new_accessors") {
  const test::TemporaryFolder folder;
  GltfParts parts = test::patch();
  const std::vector<std::int16_t> shorts = {0, 0, 0, 0, 100, 0, 0, 0, 0, 100, 0, 0, 100, 100, 0, 0};
  const std::size_t view = parts.view(shorts);
  parts.json["bufferViews"][view]["byteStride"] = 8;
  parts.json["accessors"].push_back(
      {{"bufferView", view}, {"componentType", 5122}, {"count", 4}, {"type", "VEC3"}});
  const std::size_t positions = parts.json["accessors"].size() - 1;
  const std::size_t indices = parts.accessor(std::vector<std::uint8_t>{0, 1, 2}, 5121, "SCALAR", 1);
  parts.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  parts.json["meshes"].push_back(
      {{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}}});
  parts.json["nodes"].push_back({{"mesh", 1}, {"scale", {0.01, 0.01, 0.01}}});
  parts.json["scenes"] = {{{"nodes", {0, 1}}}};
  parts.json["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}},
                               {"samplers", {{{"input", 0}, {"output", 0}}}}}};
  const ReadResult r = test::put_and_read(folder / "a.glb", parts.glb());
  CHECK(mentions(r.warnings.at(0), "animations are ignored"));
  const auto posed = raised(r.surface, 0.5);
  rewrite(r, folder / "b.glb", posed);
  const ReadResult again = read(folder / "b.glb");
  CHECK(largest_distance(again.surface.positions, posed) < 1e-6);
  const std::string out = test::file_bytes(folder / "b.glb");
  CHECK(accessor_of(out, 0, "POSITION") != 0);  // the animation still uses accessor 0
  CHECK(floats_by_judge(folder / "b.glb", 0) == floats_by_judge(folder / "a.glb", 0));
}

TEST_CASE("external_buffer_is_written_beside_without_overwriting_other_files") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "in");
  std::filesystem::create_directory(folder / "out");
  GltfParts parts = test::patch();
  parts.json["images"] = {{{"uri", "my%20paint.png"}}};
  test::put_file(folder / "in/the data.bin", parts.bytes);
  const ReadResult r = test::put_and_read(folder / "in/a.gltf", parts.beside("the%20data.bin"));
  CHECK(r.attributes->images[0].path == folder / "in/my paint.png");
  test::put_file(folder / "in/my paint.png", "a picture");
  const auto posed = raised(r.surface, 1);
  test::put_file(folder / "out/b.bin", "somebody's");
  test::put_file(folder / "out/my paint.png", "somebody's");
  const auto notes = rewrite(r, folder / "out/b.gltf", posed);
  CHECK(notes.at(0) == "copied 1 image");
  CHECK(test::file_bytes(folder / "out/my paint.png") == "somebody's");
  CHECK(test::file_bytes(folder / "out/my paint-2.png") == "a picture");
  CHECK(test::file_bytes(folder / "out/b.bin") == "somebody's");
  CHECK(read(folder / "out/b.gltf").surface.positions == posed);
  const GltfJson out = GltfJson::parse(test::file_bytes(folder / "out/b.gltf"));
  CHECK(out["buffers"][0]["uri"] == "b-2.bin");
  CHECK(out["images"][0]["uri"] == "my%20paint-2.png");
  CHECK(notes.at(1) == "the buffer was written to " + (folder / "out/b-2.bin").string());
  rewrite(r, folder / "out/b.gltf", raised(r.surface, 2));
  CHECK_FALSE(std::filesystem::exists(folder / "out/b-3.bin"));  // b-2.bin was replaced
  CHECK(read(folder / "out/b.gltf").surface.positions == raised(r.surface, 2));
  CHECK_THROWS_AS(rewrite(r, folder / "nowhere/b.gltf", posed), base::Error);
  CHECK_FALSE(std::filesystem::exists(folder / "nowhere"));
  rewrite(r, folder / "in/a.gltf", posed);
  CHECK(test::file_bytes(folder / "in/the data.bin") == parts.bytes);
  rewrite(r, folder / "out/c.glb", posed);
  rewrite(r, folder / "out/\xE9.gltf", posed);  // Latin-1 file name
  CHECK(read(folder / "out/\xE9.gltf").surface.positions == posed);
  CHECK(read(folder / "out/c.glb").surface.positions == posed);
}

TEST_CASE("failed_gltf_write_keeps_the_old_buffer") {
  const test::TemporaryFolder folder;
  GltfParts parts = test::patch();
  test::put_file(folder / "in.bin", parts.bytes);
  parts.json["extras"] = std::string(4000, 'x');
  const ReadResult r = test::put_and_read(folder / "in.gltf", parts.beside("in.bin"));
  rewrite(r, folder / "out.gltf", raised(r.surface, 1));
  const std::string before = test::file_bytes(folder / "out.bin");
  {
    const test::FullDisk room_for_the_buffer_alone(1000);
    CHECK_THROWS_AS(rewrite(r, folder / "out.gltf", raised(r.surface, 2)), base::Error);
  }
  CHECK(test::file_bytes(folder / "out.bin") == before);
  CHECK(folder.entries() == 4);
}

TEST_CASE("images_outside_of_the_model_folder_are_found_and_referenced") {
  const test::TemporaryFolder folder;
  for (const char* name : {"models", "textures", "far", "far/out"})
    std::filesystem::create_directory(folder / name);
  std::filesystem::create_directory_symlink(folder / "far/out", folder / "linked");
  GltfParts parts = test::patch();
  parts.json["images"] = {{{"uri", "../textures/a.png"}}, {{"uri", "http://x.org/b.png"}}};
  test::put_file(folder / "models/a.glb", parts.glb());
  test::put_file(folder / "textures/a.png", "a picture");
  const ReadResult r = read(folder / "models/a.glb");
  REQUIRE(r.warnings.size() == 1);
  CHECK(mentions(r.warnings[0], "http://x.org/b.png"));
  const auto posed = raised(r.surface, 1);
  for (const char* name : {"far/out/b.glb", "linked/c.glb"}) {
    const auto notes = rewrite(r, folder / name, posed);
    CHECK(mentions(notes.at(0), " refers to 1 image outside the folder of the old file"));
    const auto image = read(folder / name).attributes->images.at(0).path;
    CHECK(test::file_bytes(image) == "a picture");
  }
}

TEST_CASE("many_primitives_are_replaced_in_place") {
  const test::TemporaryFolder folder;
  GltfParts parts = test::patch();
  GltfJson primitives = GltfJson::array();
  std::vector<float> positions;
  constexpr std::size_t count = 8000;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(i);
    positions.insert(positions.end(), {x, 0, 0, x + 1, 0, 0, x, 1, 0});
  }
  const std::size_t view = parts.view(positions);
  for (std::size_t i = 0; i < count; ++i) {
    primitives.push_back({{"attributes", {{"POSITION", parts.json["accessors"].size()}}}});
    parts.json["accessors"].push_back({{"bufferView", view},
                                       {"byteOffset", 36 * i},
                                       {"componentType", 5126},
                                       {"count", 3},
                                       {"type", "VEC3"}});
    primitives.back()["indices"] = parts.accessor(std::vector<std::uint8_t>{0, 1, 2}, 5121, "SCALAR", 1);
  }
  parts.json["meshes"][0]["primitives"] = primitives;
  const ReadResult r = test::put_and_read(folder / "a.glb", parts.glb());
  std::vector<Point> posed = r.surface.positions;
  for (Point& p : posed) p[2] = 1;
  rewrite(r, folder / "b.glb", posed);
  const ReadResult again = read(folder / "b.glb");
  CHECK(again.surface.positions == posed);
  CHECK(accessor_of(test::file_bytes(folder / "b.glb"), 0, "POSITION") ==
        accessor_of(test::file_bytes(folder / "a.glb"), 0, "POSITION"));
}

TEST_CASE("unknown_chunks_and_second_buffers_are_kept") {
  const test::TemporaryFolder folder;
  const GltfParts parts = test::patch();
  std::string glb = parts.glb();
  const std::string chunk = std::string("\x8\0\0\0XYZW12345678", 16);
  glb += chunk;
  const auto size = static_cast<std::uint32_t>(glb.size());
  std::memcpy(glb.data() + 8, &size, 4);
  const ReadResult r = test::read_kept(glb, "glb");
  rewrite(r, folder / "a.glb", raised(r.surface, 1));
  CHECK(test::file_bytes(folder / "a.glb").ends_with(chunk));
  CHECK(read(folder / "a.glb").surface.positions == raised(r.surface, 1));
  const auto notes = rewrite(r, folder / "a.gltf", raised(r.surface, 1));
  CHECK(mentions(notes.at(0), "chunks"));

  GltfJson twice = GltfJson::parse(parts.beside("data.bin"));
  twice["buffers"].push_back(twice["buffers"][0]);
  twice["bufferViews"][1]["buffer"] = 1;
  test::put_file(folder / "data.bin", parts.bytes);
  const ReadResult both = test::put_and_read(folder / "b.gltf", twice.dump());
  CHECK(both.surface.positions == r.surface.positions);
  rewrite(both, folder / "c.gltf", raised(both.surface, 1));
  CHECK(std::filesystem::exists(folder / "c-2.bin"));
  CHECK(read(folder / "c.gltf").surface.positions == raised(both.surface, 1));
}

TEST_CASE("gpu_instances_cause_a_warning_and_are_kept") {
  GltfParts parts = test::patch();
  parts.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  parts.json["nodes"][0]["extensions"] = {
      {"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", 0}}}}}};
  const ReadResult r = test::read_kept(parts.glb(), "glb");
  REQUIRE(r.warnings.size() == 1);
  CHECK(mentions(r.warnings[0], "EXT_mesh_gpu_instancing is not supported"));
  const test::TemporaryFolder folder;
  rewrite(r, folder / "a.glb", raised(r.surface, 1));
  CHECK(accessor_of(test::file_bytes(folder / "a.glb"), 0, "POSITION") != 0);  // instances use accessor 0
}

TEST_CASE("surface_beyond_float_range_is_not_written_as_glb") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(write(folder / "a.glb", test::moved(test::cube(), 1e39)),
                       doctest::Contains("the position of vertex 0 is beyond 3.4e+38 (-1e+39 -1e+39 -1e+39)"),
                       base::Error);
  CHECK(folder.entries() == 0);
}

TEST_CASE("far_models_keep_their_positions_in_gltf_by_a_translation_of_the_node") {
  const test::TemporaryFolder folder;
  const Surface near = test::cube(), far = test::far_away(near);
  for (const char* name : {"a.glb", "a.gltf"}) {
    write(folder / name, far);
    const ReadResult r = read(folder / name);
    for (std::size_t c = 0; c < far.triangles.size(); ++c)
      for (std::size_t k = 0; k < 3; ++k)
        CHECK(norm(r.surface.positions[r.surface.triangles[c][k]] - far.positions[far.triangles[c][k]]) <
              1e-6);
    const std::vector<Point> posed = raised(r.surface, 1e-12);
    CHECK(write(folder / "again.glb", {r.surface, posed, {}}, r.original.get(), {}).empty());
    CHECK(norm(read(folder / "again.glb").surface.positions[0] - posed[0]) < 1e-6);
  }
  write(folder / "near.gltf", near);
  CHECK_FALSE(mentions(test::file_bytes(folder / "near.gltf"), "translation"));
}

TEST_CASE("invalid_gltf_is_rejected_with_its_place") {
  const GltfParts good = test::patch();
  const struct {
    const char* pointer;
    GltfJson value;
    const char* said;
  } rows[] = {
      {"/accessors/0/count", 4000000000U, "accessor 0: 4000000000 elements do not fit into the 96 bytes"},
      {"/accessors/0/byteOffset", 4, "accessor 0: 8 elements do not fit"},
      {"/accessors/1/count", 4, "accessor 1: has 4 elements for 8 positions"},
      {"/accessors/3/componentType", 5126, "accessor 3"},
      {"/accessors/0/bufferView", 77, "accessor 0: refers to buffer view 77"},
      {"/bufferViews/0/byteLength", 40000000, "buffer view 0: reaches past"},
      {"/bufferViews/0/buffer", 3, "buffer view 0: refers to buffer 3"},
      {"/bufferViews/0/byteStride", 4, "byteStride of 4"},
      {"/meshes/0/primitives/0/attributes/POSITION", -5,
       "mesh 0, primitive 0: \"POSITION\" should be the index of an accessor"},
      {"/meshes/0/primitives/0/attributes/POSITION", "a", "mesh 0, primitive 0: \"POSITION\" should"},
      {"/meshes/0/primitives/0/attributes", {1}, "mesh 0, primitive 0: \"attributes\" should be an object"},
      {"/meshes/0/primitives/0/indices", 99, "mesh 0, primitive 0: \"indices\" refers to accessor 99"},
      {"/meshes/0/primitives", {nullptr}, "mesh 0: \"primitives\" should be a list of objects"},
      {"/meshes/0/primitives", 3, "mesh 0: \"primitives\" should be a list of objects"},
      {"/nodes/0/children", {{"a", 1}}, "node 0: \"children\" should be a list of whole"},
      {"/nodes/0/mesh", -5, "node 0: \"mesh\" should be a whole number"},
      {"/nodes/0/scale", {"1", 1, 1}, "node 0: \"scale\" should be a list of numbers"},
      {"/nodes", nullptr, "\"nodes\" should be a list of objects"},
      {"/nodes/0/mesh", 9, "node 0: refers to mesh 9"},
      {"/nodes/0/children", {0}, "node 0: is placed twice"},
      {"/nodes/0/children", {5}, "node 5: does not exist"},
      {"/scene", 4, "scene 4 does not exist"},
      {"/asset/version", "1.0", "glTF 1.0 is not supported"},
      {"/extensionsUsed", {"KHR_draco_mesh_compression"}, "compressed (KHR_draco_mesh_compression)"},
      {"/extensionsRequired", {"VENDOR_magic"}, "requires the extension VENDOR_magic"},
      {"/nodes/0/translation", {1e200, 0, 0}, "is not a finite number up to 1e100"}};
  for (const auto& [pointer, value, said] : rows) {
    GltfParts bad = good;
    bad.json[GltfJson::json_pointer(pointer)] = value;
    const std::string found = refusal_of(bad);
    CHECK_MESSAGE(mentions(found, said), found);
  }
  GltfParts past = good;
  const std::size_t indices = past.accessor(std::vector<std::uint16_t>{0, 1, 8}, 5123, "SCALAR", 1);
  past.primitive()["indices"] = indices;
  CHECK(mentions(refusal_of(past), "has index 8, the primitive has 8 vertices"));

  CHECK(mentions(test::refusal(good.glb().substr(0, 400), "glb"), "the header declares"));
  CHECK(mentions(test::refusal("{\"asset\":{\"version\":\"2.0\"", "gltf"), "invalid JSON at byte"));
  CHECK(mentions(test::refusal("{\"asset\":" + std::string(100000, '['), "gltf"),
                 "nested more than 64 levels"));
  CHECK(mentions(test::refusal(good.beside("missing.bin"), "gltf"), "missing.bin"));
  for (const char* outside :
       {"../secret.bin", "/etc/passwd", "a/../../b.bin", "%2e%2e/b.bin", "http://x.org/b.bin"})
    CHECK(mentions(test::refusal(good.beside(outside), "gltf"), "is not in the folder of the model"));
}

TEST_CASE("basis_textures_are_not_shown_unless_the_file_has_another_image") {
  GltfParts parts = test::patch();
  parts.json["textures"][0]["extensions"]["KHR_texture_basisu"]["source"] = 0;
  parts.json["extensionsRequired"] = GltfJson::array({"KHR_texture_basisu"});
  CHECK(test::read_text(parts.glb(), "glb").warnings.empty());
  parts.json["textures"][0].erase("source");
  const ReadResult read = test::read_text(parts.glb(), "glb");
  CHECK(read.attributes->materials[0].base_color_image == mesh::none);
  CHECK(mentions(read.warnings.at(0), "Basis textures (KHR_texture_basisu) are not shown"));
}

TEST_CASE("instancing_is_limited") {
  GltfParts parts = test::patch();
  std::vector<float> many(3 * 100000);
  const std::size_t positions = parts.accessor(many, 5126, "VEC3", 3);
  parts.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
  GltfJson nodes = GltfJson::array(), all = GltfJson::array();
  for (int i = 0; i < 200; ++i) {
    nodes.push_back({{"mesh", 0}});
    all.push_back(i);
  }
  parts.json["nodes"] = nodes;
  parts.json["scenes"][0]["nodes"] = all;
  CHECK(mentions(test::refusal(parts.glb(), "glb"), "more than 4 million vertices"));
}

TEST_CASE("deformed_mesh_of_a_flattening_node_is_rejected") {
  const test::TemporaryFolder folder;
  GltfParts parts = test::patch();
  parts.json["nodes"][0]["scale"] = {1, 1, 0};
  const ReadResult r = test::put_and_read(folder / "a.glb", parts.glb());
  CHECK_THROWS_WITH_AS(rewrite(r, folder / "b.glb", raised(r.surface, 1)),
                       doctest::Contains("node 0: scales its mesh to zero thickness"), base::Error);
  CHECK(folder.entries() == 1);
}
