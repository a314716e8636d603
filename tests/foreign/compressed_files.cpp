// Compressed glTF files, decompressed by viete-import and compared with the same files without compression.
#include <map>
#include <random>

#include "base/error.h"
#include "foreign/compressed_gltf.h"
#include "foreign/read.h"
#include "support/data.h"
#include "support/distance.h"
#include "support/folder.h"
#include "support/shapes.h"
#include "support/skip.h"
#include "support/text.h"

using namespace viete;
using formats::GltfJson;
using test::GltfParts, test::mentions, test::TakenGltf;
namespace fs = std::filesystem;

namespace {

struct Packed : test::TemporaryFolder {
  Packed() { test::set_environment("VIETE_IMPORT", (test::build_dir() / "viete-import").string()); }
  ~Packed() { unsetenv("VIETE_IMPORT"); }

  formats::ReadResult read(const std::string& bytes, const std::string& name = "a.glb",
                           double seconds = 60) const {
    test::put_file(*this / name, bytes);
    return foreign::read(*this / name, nullptr, false, seconds);
  }
  formats::ReadResult read(const GltfParts& parts) const { return read(parts.glb()); }

  std::string problem(const GltfParts& parts) const {
    return test::problem_of([&] { read(parts); });
  }

  // Returns the file that is written after opening a compressed file.
  std::string decompressed(const std::string& bytes, const std::string& name = "a.glb") const {
    const formats::ReadResult result = read(bytes, name);
    CHECK(mentions(result.warnings.back(), "); saving writes it uncompressed"));
    CHECK(result.original
              ->write_file(*this / "out.glb", {result.surface, result.surface.positions, {}}, {}, nullptr)
              .empty());
    return test::file_bytes(*this / "out.glb");
  }
};

GltfJson& draco_extension(GltfParts& parts) {
  return parts.primitive()["extensions"]["KHR_draco_mesh_compression"];
}

// All numbers of the first primitive, by attribute.
using Numbers = std::map<std::string, std::vector<double>>;

Numbers numbers_of(const std::string& glb) {
  const TakenGltf taken(glb);
  const GltfJson& primitive = taken.file.document["meshes"][0]["primitives"][0];
  Numbers numbers;
  const auto add = [&](const std::string& name, int accessor) {
    numbers[name] = taken.accessors.numbers(accessor, taken.accessors.components(accessor));
  };
  for (const auto& [name, accessor] : primitive["attributes"].items()) add(name, accessor);
  add("indices", primitive["indices"]);
  for (const GltfJson& target : formats::list_of(primitive, "targets")) add("target", target["POSITION"]);
  CHECK(taken.file.document["images"][0].contains("bufferView"));
  CHECK(taken.file.images[0].file.bytes->starts_with("\x89PNG"));
  CHECK_FALSE(mentions(taken.file.document.dump(), "compression"));
  return numbers;
}

void require_equal(const Numbers& found, const Numbers& expected) {
  REQUIRE(found.size() == expected.size());
  for (const auto& [name, values] : expected) CHECK_MESSAGE(found.at(name) == values, name);
}

// The triangles by the texture points of their corners, beginning with the lowest corner.
std::vector<std::array<std::array<double, 2>, 3>> triangles_of(const Numbers& numbers) {
  std::vector<std::array<std::array<double, 2>, 3>> triangles;
  const auto &texture = numbers.at("TEXCOORD_0"), &indices = numbers.at("indices");
  for (std::size_t c = 0; c < indices.size(); c += 3) {
    auto& t = triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(indices[c + k]);
      t[k] = {texture[2 * v], texture[2 * v + 1]};
    }
    std::ranges::rotate(t, std::ranges::min_element(t));
  }
  std::ranges::sort(triangles);
  return triangles;
}

}  // namespace

TEST_CASE("draco_without_quantization_keeps_every_number_and_the_order") {
  const Packed folder;
  const GltfParts plain = test::grid(9);
  const std::string out = folder.decompressed(test::with_draco(plain, true, 0).glb());
  require_equal(numbers_of(out), numbers_of(plain.glb()));
  const GltfJson position = TakenGltf(out).file.document["accessors"][0];
  CHECK(position["max"][0].get<float>() == 3 * (8.0F / 9));  // the bounds of the plain file are too wide
}

TEST_CASE("draco_with_quantization_keeps_triangles_and_places_within_half_a_step") {
  const Packed folder;
  const GltfParts plain = test::grid(40);
  const Numbers expected = numbers_of(plain.glb());
  for (const int bits : {8, 11, 14}) {
    GltfParts packed = test::with_draco(plain, false, bits);
    packed.primitive().erase("targets");  // they need the order
    const Numbers found = numbers_of(folder.decompressed(packed.glb()));
    CHECK(triangles_of(found) == triangles_of(expected));
    std::map<std::array<double, 2>, std::size_t> by_texture;
    for (std::size_t v = 0; v < 1600; ++v)
      by_texture[{expected.at("TEXCOORD_0")[2 * v], expected.at("TEXCOORD_0")[2 * v + 1]}] = v;
    REQUIRE(found.at("POSITION").size() == 3 * 1600);
    double largest = 0;
    for (std::size_t v = 0; v < 1600; ++v) {
      const std::size_t e = by_texture.at({found.at("TEXCOORD_0")[2 * v], found.at("TEXCOORD_0")[2 * v + 1]});
      for (std::size_t k = 0; k < 3; ++k) {
        largest =
            std::max(largest, std::abs(found.at("POSITION")[3 * v + k] - expected.at("POSITION")[3 * e + k]));
        CHECK(found.at("COLOR_0")[3 * v + k] == expected.at("COLOR_0")[3 * e + k]);
        CHECK(found.at("JOINTS_0")[4 * v + k] == expected.at("JOINTS_0")[4 * e + k]);
      }
    }
    const double step = 3 * (39.0 / 40) / ((1 << bits) - 1);
    MESSAGE(bits, " bits: positions differ by ", largest / step, " steps at most");
    CHECK(largest < 0.51 * step);
    CHECK(largest > 0);
  }
}

TEST_CASE("meshopt_keeps_every_bit") {
  const Packed folder;
  const GltfParts plain = test::grid(20);
  const Numbers expected = numbers_of(plain.glb());
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
    require_equal(numbers_of(folder.decompressed(test::with_meshopt(plain, "INDICES", name).glb())),
                  expected);
  Numbers turned = numbers_of(folder.decompressed(test::with_meshopt(plain, "TRIANGLES").glb()));
  CHECK(triangles_of(turned) == triangles_of(expected));  // this mode can begin triangles with another corner
  turned["indices"] = expected.at("indices");
  require_equal(turned, expected);
}

TEST_CASE("filters_of_meshopt_restore_normals_rotations_and_floats") {
  const Packed folder;
  GltfParts packed = test::grid(8);
  const Numbers plain = numbers_of(packed.glb());
  constexpr std::size_t count = 64;
  std::vector<float> directions;  // of normals, and of quaternions
  for (std::size_t i = 0; i < count; ++i) {
    const float angle = 0.1F * static_cast<float>(i);
    directions.insert(directions.end(), {0.6F * std::sin(angle), 0.6F * std::cos(angle), 0.8F, 0});
  }
  std::vector<float> places(plain.at("POSITION").begin(), plain.at("POSITION").end());
  const auto add = [&](const char* filter, std::string filtered, std::size_t stride) {
    const auto [bytes, members] = test::meshopt_bytes(filtered, stride, "ATTRIBUTES");
    const std::size_t view = packed.view(std::vector<char>(bytes.begin(), bytes.end()));
    GltfJson& json = packed.json["bufferViews"][view];
    json["extensions"]["EXT_meshopt_compression"] = members;
    json["extensions"]["EXT_meshopt_compression"].update(
        {{"byteOffset", json["byteOffset"]}, {"filter", filter}});
    json["byteLength"] = filtered.size();
    json["byteStride"] = stride;
    return view;
  };
  std::string octahedral(4 * count, '\0'), wide(8 * count, '\0'), quaternions(8 * count, '\0'),
      exponential(12 * count, '\0');
  meshopt_encodeFilterOct(octahedral.data(), count, 4, 8, directions.data());
  meshopt_encodeFilterOct(wide.data(), count, 8, 16, directions.data());
  meshopt_encodeFilterQuat(quaternions.data(), count, 8, 16, directions.data());
  for (std::size_t i = 0; i < places.size(); ++i) {  // a mantissa of 24 bits, an exponent of 8 bits
    int exponent = 0;
    const auto mantissa = static_cast<std::int32_t>(std::ldexp(std::frexp(places[i], &exponent), 22));
    const std::uint32_t number =
        (static_cast<std::uint32_t>(mantissa) & 0xFFFFFF) | static_cast<std::uint32_t>(exponent - 22) << 24;
    std::memcpy(&exponential[4 * i], &number, 4);
  }
  const auto accessor = [&](std::size_t view, int type, const char* kind) {
    packed.json["accessors"].push_back({{"bufferView", view},
                                        {"componentType", type},
                                        {"count", count},
                                        {"type", kind},
                                        {"normalized", type != 5126}});
    return packed.json["accessors"].size() - 1;
  };
  GltfJson& attributes = packed.primitive()["attributes"];
  attributes["NORMAL"] = accessor(add("OCTAHEDRAL", octahedral, 4), 5120, "VEC3");
  attributes["_WIDE"] = accessor(add("OCTAHEDRAL", wide, 8), 5122, "VEC3");
  attributes["_ROTATION"] = accessor(add("QUATERNION", quaternions, 8), 5122, "VEC4");
  attributes["POSITION"] = accessor(add("EXPONENTIAL", exponential, 12), 5126, "VEC3");
  packed.json["extensionsUsed"] = GltfJson::array({"EXT_meshopt_compression", "KHR_mesh_quantization"});
  const Numbers found = numbers_of(folder.decompressed(packed.glb()));
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double direction = static_cast<double>(directions[4 * i + k]);
      CHECK(std::abs(found.at("NORMAL")[3 * i + k] - direction) < 0.02);
      CHECK(std::abs(found.at("_WIDE")[3 * i + k] - direction) < 1e-4);
      CHECK(std::abs(found.at("_ROTATION")[4 * i + k] - direction) < 1e-4);
      CHECK(std::abs(found.at("POSITION")[3 * i + k] - plain.at("POSITION")[3 * i + k]) < 1e-6);
    }
}

TEST_CASE("strips_fallbacks_and_shared_draco_data_are_decoded") {
  const Packed folder;
  const GltfParts plain = test::grid(5);
  const Numbers expected = numbers_of(plain.glb());
  GltfParts packed = test::with_draco(plain, true, 0);
  packed.primitive()["mode"] = 5;
  packed.primitive().erase("indices");
  packed.primitive()["attributes"].erase("NORMAL");
  draco_extension(packed)["attributes"].erase("NORMAL");
  packed.json["meshes"][0]["primitives"].push_back(packed.primitive());
  const std::string out = folder.decompressed(packed.glb());
  Numbers found = numbers_of(out);
  found["NORMAL"] = expected.at("NORMAL");
  require_equal(found, expected);
  const GltfJson document = TakenGltf(out).file.document;
  CHECK(document["meshes"][0]["primitives"][1] == document["meshes"][0]["primitives"][0]);

  GltfParts both = plain;  // uncompressed data for other programs
  const GltfParts draco = test::with_draco(plain, true, 0);
  const GltfJson& view = draco.json["bufferViews"][1];
  const std::string bytes = draco.bytes.substr(view["byteOffset"], view["byteLength"]);
  const std::size_t added = both.view(std::vector<char>(bytes.begin(), bytes.end()));
  both.primitive()["extensions"] = draco.json["meshes"][0]["primitives"][0]["extensions"];
  draco_extension(both)["bufferView"] = added;
  both.json["extensionsUsed"] = GltfJson::array({"KHR_draco_mesh_compression"});
  require_equal(numbers_of(folder.decompressed(both.glb())), expected);
}

TEST_CASE("compressed_files_are_deformed_and_written_in_both_formats") {
  const Packed folder;
  const GltfParts plain = test::grid(7);
  for (const GltfParts& packed : {test::with_draco(plain, true, 0), test::with_meshopt(plain, "INDICES")}) {
    std::string text = packed.beside("a.bin");
    GltfJson document = GltfJson::parse(text);
    if (packed.json.contains("buffers")) document["buffers"].push_back(packed.json["buffers"][1]);
    document["images"][0] = {{"uri", "image.png"}};
    test::put_file(folder / "a.bin", packed.bytes);
    test::put_file(folder / "image.png", "\x89PNG image");
    for (const std::string name : {"a.glb", "a.gltf"}) {
      const formats::ReadResult read = folder.read(name == "a.glb" ? packed.glb() : document.dump(), name);
      CHECK(read.format == "glTF compressed");
      CHECK(formats::describes(formats::holds_morphs, read.format));
      REQUIRE(read.original->morphs());
      CHECK(read.original->morphs()->at_target(0)[48][2] ==
            doctest::Approx(read.surface.positions[48][2] + 12.0 / 7));
      std::vector<mesh::Point> raised = read.surface.positions;
      for (mesh::Point& p : raised) p[1] += 0.25;
      const fs::path out = folder / ("out" + fs::path(name).extension().string());
      read.original->write_file(out, {read.surface, raised, {}}, {}, nullptr);
      const formats::ReadResult again = formats::read(out);  // this reader refuses compressed files
      CHECK(test::largest_distance(again.surface.positions, raised) < 1e-6);
      CHECK(again.surface.corners == read.surface.corners);
      CHECK(again.attributes->materials[0].name == "paint");
      const formats::ImageFile& image = again.attributes->images[0];
      CHECK((name == "a.glb" ? image.bytes != nullptr : fs::equivalent(image.path, folder / "image.png")));
    }
  }
}

TEST_CASE("damaged_compressed_files_are_refused_with_their_place") {
  const Packed folder;
  const GltfParts draco = test::with_draco(test::grid(5), true, 0),
                  meshopt = test::with_meshopt(test::grid(5), "TRIANGLES");
  const std::string failed = "a.glb: the compressed meshes cannot be read: ";
  const auto expect = [&](GltfParts parts, const char* pointer, const GltfJson& value,
                          const std::string& said) {
    parts.json[GltfJson::json_pointer(pointer)] = value;
    const std::string found = folder.problem(parts);
    CHECK_MESSAGE(mentions(found, failed + said), std::string(pointer), ": ", found);
  };
  const std::string primitive = "mesh 0, primitive 0";
  const std::string extension = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
  expect(draco, (extension + "/bufferView").c_str(), 99,
         primitive + ": its Draco data is in no buffer view of the file; export");
  expect(draco, (extension + "/bufferView").c_str(), 0, primitive + ": its Draco data is damaged (");
  expect(draco, (extension + "/attributes/NORMAL").c_str(), 99,
         primitive + ", NORMAL: its accessor or its Draco data is missing");
  expect(draco, (extension + "/attributes/NORMAL").c_str(), 4294967306U,
         primitive + ", NORMAL: its accessor or");
  expect(draco, (extension + "/attributes").c_str(), {1}, primitive + ", 0: its accessor or");
  expect(draco, "/accessors/0/type", "VEC2",
         primitive + ", POSITION: its Draco data has 3 components, its accessor is VEC2");
  expect(draco, "/accessors/0/componentType", 5121,
         primitive + ", POSITION: a value of its Draco data does not fit");
  expect(draco, "/bufferViews/1/byteLength", 4000000000U, primitive + ": reaches past the");
  expect(draco, "/bufferViews/1/byteLength", 200, primitive + ": its Draco data is damaged (");
  const std::string view = "/bufferViews/0/extensions/EXT_meshopt_compression/";
  expect(meshopt, (view + "count").c_str(), 4000000000U,
         "buffer view 0: 4000000000 elements do not fit into");
  expect(meshopt, (view + "count").c_str(), 100, "buffer view 0: the compressed data is damaged");
  expect(meshopt, (view + "byteStride").c_str(), 258,
         "buffer view 0: mode ATTRIBUTES with filter NONE cannot have 25 elements of 258 bytes");
  expect(meshopt, (view + "byteStride").c_str(), 0, "buffer view 0: mode ATTRIBUTES");
  expect(meshopt, (view + "mode").c_str(), "INDICES", "buffer view 0: mode INDICES with");
  expect(meshopt, (view + "mode").c_str(), "MAGIC", "buffer view 0: mode MAGIC with");
  expect(meshopt, (view + "filter").c_str(), "COLOR", "buffer view 0: mode ATTRIBUTES with filter COLOR");
  expect(meshopt, (view + "filter").c_str(), "QUATERNION",
         "buffer view 0: mode ATTRIBUTES with filter QUATERNION");
  expect(meshopt, (view + "buffer").c_str(), 7, "buffer view 0: has no byteLength or refers to a buffer");
  expect(meshopt, (view + "byteLength").c_str(), 20, "buffer view 0: the compressed data is damaged");
  GltfParts bomb = meshopt;
  for (int i = 0; i < 100; ++i) bomb.json["bufferViews"].push_back(bomb.json["bufferViews"][0]);
  CHECK(mentions(folder.problem(bomb), "overlaps too many other buffer views"));
  expect(meshopt, "/bufferViews/0/extensions", nullptr,
         "buffer view 0: reaches past the 0 bytes of its buffer");
}

TEST_CASE("without_decoders_the_error_names_what_to_install") {
  const Packed folder;
  test::set_environment("VIETE_IMPORT", (folder / "none").string());
  const GltfParts plain = test::grid(3);
  CHECK(mentions(
      folder.problem(test::with_draco(plain, true, 0)),
      "a.glb: the meshes are compressed (KHR_draco_mesh_compression), and are read by viete-import: this "
      "program is not installed; install Draco (libdraco-dev) and build Viete again, or export without "
      "compression"));
  CHECK(mentions(folder.problem(test::with_meshopt(plain, "INDICES")),
                 "install meshoptimizer (libmeshoptimizer-dev)"));
  CHECK(folder.read(plain).warnings.empty());  // other files need no program
  const GltfParts packed = test::with_draco(plain, true, 0);
  for (const auto& [script, said] : std::vector<std::pair<std::string, const char*>>{
           {"kill -SEGV $$",
            "a.glb: the compressed meshes cannot be read: it crashed, or used too much memory or time; "
            "export"},
           {"echo glTF", "a.glb: the file ends within its header"},
           {"cat \"$2\"",
            "a.glb: the meshes are compressed (KHR_draco_mesh_compression), which is not supported"},
           {"echo Hello", "a.glb: viete-import sent no valid scene"}}) {
    test::put_file(folder / "import", "#!/bin/sh\n" + script + "\n");
    fs::permissions(folder / "import", fs::perms::owner_all);
    test::set_environment("VIETE_IMPORT", (folder / "import").string());
    CHECK_MESSAGE(mentions(folder.problem(packed), said), folder.problem(packed));
  }
}

TEST_CASE("changed_compressed_files_never_crash_or_hang_the_program" * doctest::test_suite(test::longer)) {
  const Packed folder;
  const GltfParts plain = test::grid(6);
  const std::string seeds[] = {
      test::with_draco(plain, true, 0).glb(), test::with_draco(plain, false, 10).glb(),
      test::with_meshopt(plain, "TRIANGLES").glb(), test::with_meshopt(plain, "INDICES").glb()};
  std::mt19937 random(7);
  int read = 0, crashed = 0;
  const int rounds = test::rounds(60, 3000);
  for (int round = 0; round < rounds; ++round) {
    std::string bytes = seeds[round % 4];
    // Mostly changes the compressed data, because damaged JSON is refused early.
    const std::size_t from = random() % 8 == 0 ? 20 : bytes.find(std::string("BIN\0", 4)) + 4;
    for (auto change = random() % 8 + 1; change > 0; --change)
      bytes[from + random() % (bytes.size() - from)] = static_cast<char>(random() % 3 == 0 ? 255 : random());
    try {
      CHECK_FALSE(folder.read(bytes).surface.positions.empty());
      ++read;
    } catch (const base::Error& error) {
      CHECK_FALSE(mentions(error.what(), "took longer"));
      crashed += mentions(error.what(), "crashed") ? 1 : 0;
    }
  }
  MESSAGE(rounds, " changed files: ", read, " are read, ", crashed, " crash viete-import");
  CHECK(read > 0);
}

TEST_CASE("a_model_of_another_encoder_is_read" * doctest::test_suite(test::if_present)) {
  const fs::path models = "/usr/share/assimp/models/glTF2";
  if (!fs::exists(models / "draco")) return test::skip("assimp-testmodels is not installed");
  const Packed folder;
  const auto packed = foreign::read(models / "draco/2CylinderEngine.gltf"),
             plain = foreign::read(models / "2CylinderEngine-glTF-Binary/2CylinderEngine.glb");
  const mesh::Bounds box = mesh::bounds(packed.surface.positions),
                     expected = mesh::bounds(plain.surface.positions);
  CHECK(mesh::norm(box.low - expected.low) + mesh::norm(box.high - expected.high) <
        1e-4 * expected.diagonal());
}
