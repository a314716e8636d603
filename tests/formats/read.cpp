#include "formats/read.h"

#include <nlohmann/json.hpp>

#include "formats/source.h"
#include "formats/write.h"
#include "support/data.h"
#include "support/shapes.h"

namespace fs = std::filesystem;
using namespace viete;
using namespace viete::formats;
using namespace viete::mesh;
using viete::test::mentions;

namespace {

std::string refusal_of(const fs::path& path) {
  try {
    read(path);
  } catch (const base::Error& error) {
    CHECK(!error.place().empty());
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("content_decides_the_format_and_not_the_extension") {
  const Surface s = test::sphere(1);
  const std::pair<std::string, std::string> files[] = {{"OBJ", test::bytes_by("obj", s)},
                                                       {"PLY binary little-endian", test::bytes_by("ply", s)},
                                                       {"OFF", test::bytes_by("off", s)},
                                                       {"STL ascii", test::bytes_by("stl", s)}};
  for (const auto& [format, bytes] : files)
    for (const char* extension : {"obj", "ply", "off", "stl", "", "txt"}) {
      if (format == "OBJ" && std::string(extension) == "stl") continue;  // OBJ has no signature: STL is tried
      const ReadResult r = test::read_text(bytes, extension);
      CHECK(r.format == format);
      CHECK(r.surface.triangles.size() == s.triangles.size());
    }
}

TEST_CASE("content_without_a_surface_is_rejected") {
  std::mt19937 random(5);
  std::string garbage(4096, '\0');
  for (char& c : garbage) c = static_cast<char>(random());
  for (const char* extension : {"obj", "ply", "off", "stl", "", "txt"})
    for (const std::string& text :
         {garbage, std::string("Dear reader,\nthis is a letter.\n"), std::string("\n\n\n")})
      CHECK(test::refusal(text, extension).starts_with("given."));
}

TEST_CASE("unreadable_files_are_rejected_with_a_reason") {
  const test::TemporaryFolder folder;
  CHECK(refusal_of(folder / "none.obj").find("there is no such file") != std::string::npos);
  fs::create_directory(folder / "folder.obj");
  CHECK(refusal_of(folder / "folder.obj").find("this is a folder") != std::string::npos);
  CHECK(refusal_of("/dev/zero").find("not a regular file") != std::string::npos);
  CHECK(!refusal_of("").empty());
  CHECK(!refusal_of(std::string(5000, 'x') + ".obj").empty());
}

TEST_CASE("file_names_may_hold_anything") {
  const test::TemporaryFolder folder;
  const std::string text = test::bytes_by("obj", test::cube());
  for (const std::string name : {"-dash.obj", "it's \"odd\" & $HOME;.OBJ", "\xE5\x90\x8D\xE5\x89\x8D.obj",
                                 "a.b.c", "none", " ", "new\nline.obj"}) {
    test::put_file(folder / name, text);
    CHECK(read(folder / name).surface.triangles.size() == 12);
  }
}

TEST_CASE("progress_rises_to_one_and_a_cancelled_reading_stops") {
  const test::TemporaryFolder folder;
  const Surface s = test::sphere(6);
  for (const char* name : {"a.obj", "a.ply", "a.off", "a.stl"}) {
    write(folder / name, s);
    base::Progress progress;
    CHECK(read(folder / name, &progress).surface.triangles.size() == s.triangles.size());
    CHECK(progress.done() == 1);
    base::Progress cancelled;
    cancelled.cancel();
    CHECK_THROWS_AS(read(folder / name, &cancelled), base::Cancelled);
    const std::string bytes = test::file_bytes(folder / name);
    CHECK_THROWS_AS(read(Source{"a", "obj", bytes, &cancelled}), base::Cancelled);
  }
}

TEST_CASE("damaged_files_never_break_an_invariant") {
  const Surface s = test::sphere(1);
  std::string ascii_ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::pair<std::string, std::string> seeds[] = {
      {"obj", test::bytes_by("obj", test::cube(), {"a comment"})},
      {"ply", test::bytes_by("ply", s, {"a comment"})},
      {"ply", ascii_ply},
      {"off", test::bytes_by("off", s, {"a comment"})},
      {"stl", test::bytes_by("stl", s)}};
  std::mt19937 random(11);
  const std::string alphabet = std::string("0123456789.-+eE/\\#\r\n \t\0\x7f\xffvf", 28);
  int loaded = 0, refused = 0;
  for (const auto& [extension, seed] : seeds)
    for (int i = 0; i < 1500; ++i) {
      std::string bytes = seed;
      for (unsigned k = random() % 4; k-- > 0;)
        bytes[random() % bytes.size()] = alphabet[random() % alphabet.size()];
      if (i % 3 == 0) bytes.resize(random() % bytes.size());
      if (i % 5 == 0) bytes.insert(random() % (bytes.size() + 1), 1, alphabet[random() % alphabet.size()]);
      try {
        test::check_invariants(test::read_text(bytes, extension).surface);
        ++loaded;
      } catch (const base::Error&) {
        ++refused;
      }
    }
  CHECK(loaded > 500);
  CHECK(refused > 500);
}

TEST_CASE("every_odd_file_of_the_shared_data_does_what_its_manifest_expects" *
          doctest::test_suite(test::if_present)) {
  const fs::path folder = test::shared_data("bad");
  if (folder.empty()) return;
  const test::TemporaryFolder unpacked;
  const std::string unpack =
      "tar -xf '" + (folder / "odd_names.tar").string() + "' -C '" + (unpacked / "").string() + "'";
  REQUIRE(std::system(unpack.c_str()) == 0);
  std::ifstream manifest(folder / "manifest.json");
  int entries = 0;
  for (const auto& entry : nlohmann::json::parse(manifest)) {
    const std::string name = entry["file"], kind = entry["kind"], expect = entry["expect"];
    if (kind == "other") continue;
    ++entries;
    const fs::path path = entry.contains("in") ? unpacked / name : folder / name;
    CAPTURE(name);
    try {
      const Surface s = read(path).surface;
      test::check_invariants(s);
      CHECK_MESSAGE((expect != "reject" || kind != "mesh"), name);
      if (entry.contains("vertices")) CHECK(s.positions.size() == entry["vertices"].get<std::size_t>());
      if (entry.contains("triangles")) CHECK(s.triangles.size() == entry["triangles"].get<std::size_t>());
    } catch (const base::Error& error) {
      CHECK_MESSAGE(expect != "load", error.what());
      CHECK(error.place().find(path.string()) == 0);
    }
  }
  CHECK(entries > 100);
}

TEST_CASE("foreign_files_are_rejected_with_their_kind") {
  const std::string lfs = "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a2146\nsize 12345\n";
  const std::pair<std::string, const char*> files[] = {
      {lfs, "Git LFS pointer, not the file itself; fetch the file itself with `git lfs pull`"},
      {"/annex/objects/SHA256E-s1--a.obj\n", "git annex get"},
      {std::string("\x1F\x8B\x08\0\0", 5), "gzip"},
      {"PK\3\4....", "zip"},
      {std::string("\xFF\xFEv\0 \0", 6), "UTF-16"},
      {std::string("\xFE\xFF\0v\0 ", 6), "UTF-16"},
      {"<!doctype HTML>\n<html><body>Not found", "a web page; download the model file"},
      {"\xEF\xBB\xBF\n  <HTML>", "a web page"},
      {"<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"\">", "a COLLADA file"},
      {"<?xml version=\"1.0\"?>\n<something>", "XML"},
      {"Kaydara FBX Binary  ", "an FBX file"},
      {"; FBX 7.3.0 project file\n", "an FBX file"},
      {"#usda 1.0\n", "a USD file"},
      {"PXR-USDC", "a USD file"},
      {"BLENDER-v300", "a Blender file"},
      {"\x28\xB5\x2F\xFD....", "zstd"},
      {"\x89PNG\r\n", "a picture"},
      {std::string("POINTCACHE2\0", 12), "a point cache"},
      {std::string(3000, '\0'), "only zero bytes"},
      {"", "the file is empty"}};
  for (const auto& [bytes, what] : files)
    for (const char* extension : {"obj", "ply", "off", "stl", "glb", "gltf", ""}) {
      const std::string said = test::refusal(bytes, extension);
      CHECK_MESSAGE(mentions(said, what), extension << ": " << said);
    }
  for (const char* bytes :
       {"v 1 2 3\n", "# version https://git-lfs.github.com/spec/v1\n", "{\"a\": 1}", "solid a\n"})
    CHECK_NOTHROW(refuse_foreign("given", bytes));
}
