// The table of formats: its rows say what readers and writers do, and what shells and desktops are told.
#include "mesh/formats/format_table.h"

#include <doctest/doctest.h>

#include "mesh/formats/read.h"
#include "mesh/formats/write.h"
#include "mesh/shapes.h"
#include "support/data.h"

using namespace viete;
using namespace viete::mesh;

namespace {

// A quad and a triangle; the first vertex that a face names is not the first one, and one is of no face.
Surface odd_surface() {
  return test::read_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 2 0\nv 5 5 5\nf 3 4 1 2\nf 5 4 3\n", "obj")
      .surface;
}

std::string asset(const std::string& file) {
  return test::file_bytes(test::assets_dir() / file);
}

}  // namespace

TEST_CASE("rows_say_what_becomes_of_a_surface") {
  const test::TemporaryFolder folder;
  const Surface surface = odd_surface();
  for (const Format& format : all_formats()) {
    if (!format.write) continue;
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

TEST_CASE("lists_of_formats_name_each_once") {
  CHECK(format_names(holds_surface) == "OBJ, PLY, OFF, STL or glTF");
  CHECK(format_extensions(is_sequence) == ".pc2 or .mdd");
  CHECK(a_mesh() == "Mesh (OBJ, PLY, OFF, STL, glTF)");
  CHECK(is_a(holds_morphs, "A.GLB"));
  CHECK_FALSE(is_a(holds_surface, "a.pc2"));
  CHECK_FALSE(is_a(holds_surface, "obj"));
  CHECK_THROWS_WITH_AS(surface_format("a.mdd"),
                       doctest::Contains("use .obj, .ply, .off, .stl, .glb or .gltf"), base::Error);
}

TEST_CASE("advice_to_export_a_file_of_another_kind_names_all_formats") {
  const std::string advice = "export it as " + format_names(holds_surface) + " from";
  CHECK_THROWS_WITH_AS(test::read_text("DRACO", "drc"), doctest::Contains(advice.c_str()), base::Error);
}

TEST_CASE("shells_desktops_and_the_manual_know_every_format") {
  for (const Format& format : all_formats()) {
    CAPTURE(format.extension);
    const std::string word(format.extension), name(format.name);
    for (const char* file : {"desktop/completion/viete.bash", "desktop/viete.1.in"})
      CHECK(asset(file).find(word) != std::string::npos);
    if (!format.read) continue;
    CHECK(asset("desktop/completion/viete.zsh").find(word) != std::string::npos);
    for (const char* file : {"desktop/viete.1.in", "desktop/viete.metainfo.xml", "desktop/viete.desktop"})
      CHECK(asset(file).find(name) != std::string::npos);
    const bool has_own_type = asset("desktop/viete.mime.xml").find("*." + word + "\"") != std::string::npos;
    CHECK((has_own_type || asset("desktop/viete.desktop").find("model/" + word + ";") != std::string::npos));
  }
}
