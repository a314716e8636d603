// Compares the table of formats with readers, writers, shell completions and desktop entries.
#include "formats/format_table.h"

#include "formats/write.h"
#include "support/data.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::formats;
using namespace viete::mesh;

namespace {

// Returns a quad, a triangle and an unused vertex. No face starts with the first vertex.
Surface odd_surface() {
  return test::read_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 2 0\nv 5 5 5\nf 3 4 1 2\nf 5 4 3\n", "obj")
      .surface;
}

std::string name_of_format(const std::filesystem::path& file) {
  const Format* found = format_of_content(file, Beginning(file));
  return found ? std::string(found->name) : "";
}

std::string asset(const std::string& file) {
  return test::file_bytes(test::assets_dir() / file);
}

}  // namespace

TEST_CASE("format_rows_describe_what_a_format_keeps") {
  const test::TemporaryFolder folder;
  const Surface surface = odd_surface();
  for (const Format& format : all_formats()) {
    if (!format.write || format.stores_only_splats()) continue;
    CAPTURE(format.extension);
    const auto file = folder / ("a." + std::string(format.extension));
    write(file, surface);
    const ReadResult back = read(file);
    CHECK(format_of_description(back.format)->name == format.name);
    CHECK((back.surface.corners == surface.corners) == format.holds(held::polygons));
    CHECK((back.surface.positions == surface.positions) == format.keeps_order);
    if (format.recognised) CHECK(format.recognised({"a", "", test::file_bytes(file)}));
    if (format.keeps_order) {
      CHECK_NOTHROW(check_keeps_vertices(file));
    } else {
      CHECK_THROWS_WITH_AS(check_keeps_vertices(file), doctest::Contains(".obj, .ply or .off"), base::Error);
    }
    CHECK(read({file.string(), "xyz", test::file_bytes(file)}).surface.positions == back.surface.positions);
  }
}

TEST_CASE("comments_and_extra_values_do_not_hide_the_format") {
  const test::TemporaryFolder folder;
  std::string rows;
  for (int i = 0; i < 20; ++i) rows += "v 0 1 " + std::to_string(i) + "\nl 1 2\nvt 0 1\nf -1/1 1//\n";
  const std::string binary_stl =
      std::string(80, ' ') + std::string("\2\0\0\0", 4) + std::string(100, '\0') + "tail";
  const std::pair<std::string, const char*> files[] = {
      {"# comment\n\nunknown 1 2\n" + rows, "OBJ"},
      {"v 0 0 0\nv 1 0 \\\n 0 # here\nV 0 1 0 1 0.5 0\ng a b\nusemtl red\nF 1 2 3\n", "OBJ"},
      {"# long\n" + std::string(2 << 20, '\n') + rows, ""},
      {rows + std::string(1 << 20, '#') + "\n" + rows, "OBJ"},
      {"ply\nformat binary_little_endian 1.0\ncomment x\nelement vertex 0\nend_header\n", "PLY"},
      {"OFF\n3 1 0 # counts\n0 0 0\n1 0 0 0 1 0\n3 0 1 2\n", "OFF"},
      {"3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n", "OFF"},
      {"solid\nfacet normal 0 0 1\n outer loop\n vertex 0 0 0\n", "STL"},
      {binary_stl, "STL"},
      {R"({"buffers": [{"version": "1"}], "asset": {"extras": {"version": 3}, "version": "2.0"}})", "glTF"},
  };
  for (const auto& [bytes, name] : files) {
    test::put_file(folder / "file", bytes);
    CAPTURE(bytes.substr(0, 60));
    CHECK(name_of_format(folder / "file") == name);
  }
}

TEST_CASE("foreign_content_is_of_no_format") {
  const test::TemporaryFolder folder;
  const std::string elf =
      "\x7F"
      "ELF\2\1\1" +
      std::string(57, '\0') + "\1\0\0\0\4\0\0\0" + std::string("\x40\0\0\0\0\0\0\0\x40\0\0\0\0\0\0\0", 16) +
      std::string(9000, '\1');
  const std::string files[] = {
      "#include <stdio.h>\n#define v 1\n",
      "#include <stdio.h>\nint main(void) {\nv = 1;\nf(2);\nreturn 0;\n}\n",
      "# Notes\n\nA vertex is a line such as\n\nv 0 0 1\n\nand a face one such as\n\nf 1 2 3\n",
      "v is a letter\nf is another one\n",
      "# only comments\n",
      "f 1 2 3\ng a\n",
      "v 0 0 0\nv 0 0 1\nv 1 2 3" + std::string(10, '\0'),
      "ply\nwood has an odd number of layers\nend_header\n",
      "off we go\n",
      "OFF\n8 6 12 numbers of a cube\n",
      "1 2 3\n4 5 6\n",
      "solid advice\n",
      "solid advice\nfacet by facet\nvertexes\n",
      "glTF is a format for scenes\n",
      R"({"asset": "2.0", "version": "2.0"})",
      R"([{"asset": {"version": "2.0"}}])",
      R"({"a": {"asset": {"version": "2.0"}}})",
      R"({"asset": {"version": "1.1"}, "root": {}, "geometricError": 2})",
      R"({"format": "viete session", "model": "\"asset\": {\"version\": \"2.0\"}"})",
      "POINTCACHE2 is a word",
      elf,
      std::string(2000, '\0'),
      "Dear all,\n",
      "\x89PNG\r\n\x1a\n" + std::string(300, 'x')};
  for (const std::string& bytes : files) {
    test::put_file(folder / "file", bytes);
    CAPTURE(bytes.substr(0, 60));
    CHECK(name_of_format(folder / "file") == "");
  }
}

TEST_CASE("lists_of_formats_contain_each_once") {
  CHECK(format_names(holds_surface) == "OBJ, PLY, OFF, STL, glTF or SPZ");
  CHECK(format_extensions(is_sequence) == ".pc2 or .mdd");
  CHECK(is_a(holds_morphs, "A.GLB"));
  CHECK_FALSE(is_a(holds_surface, "a.pc2"));
  CHECK_FALSE(is_a(holds_surface, "obj"));
  const std::string advice = "export it as " + format_names(holds_surface) + " from";
  CHECK_THROWS_WITH_AS(test::read_text("DRACO", "drc"), doctest::Contains(advice.c_str()), base::Error);
  CHECK_THROWS_WITH_AS(surface_format("a.mdd"),
                       doctest::Contains("use .obj, .ply, .off, .stl, .glb, .gltf or .spz"), base::Error);
}

TEST_CASE("desktop_entry_lists_every_format") {
  for (const Format& format : all_formats()) {
    CAPTURE(format.extension);
    const std::string word(format.extension), name(format.name);
    if (!format.read) continue;
    for (const char* file : {"desktop/viete.metainfo.xml", "desktop/viete.desktop"})
      CHECK(asset(file).find(name) != std::string::npos);
    const bool has_own_type = asset("desktop/viete.mime.xml").find("*." + word + "\"") != std::string::npos;
    CHECK((has_own_type || asset("desktop/viete.desktop").find("model/" + word + ";") != std::string::npos));
  }
}
