// Every #include in src points where the table of rooms lets it.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "rules/room_table.h"
#include "support/data.h"

namespace fs = std::filesystem;
using viete::rules::foreign_names;
using viete::rules::includes_of;
using viete::rules::rooms;
using viete::rules::violation;

namespace {

std::string read_text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool is_source(const fs::path& path) {
  const auto e = path.extension();
  return e == ".h" || e == ".cpp" || e == ".hpp" || e == ".inl";
}

}  // namespace

TEST_CASE("every_include_in_src_is_allowed_by_the_table_of_rooms") {
  int files = 0;
  for (const auto& [room, rules] : rooms()) {
    const fs::path folder = viete::test::source_dir() / "src" / room;
    REQUIRE_MESSAGE(fs::is_directory(folder), room);
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (!is_source(entry.path())) continue;
      ++files;
      for (const auto& include : includes_of(read_text(entry.path()))) {
        const auto problem = violation(room, entry.path().extension() != ".cpp", include);
        CHECK_MESSAGE(!problem, entry.path().string(), ": ", problem.value_or(""));
      }
    }
  }
  CHECK(files > 50);
}

TEST_CASE("no_file_in_src_names_what_its_room_may_not_know") {
  for (const auto& [room, rules] : rooms()) {
    for (const auto& entry : fs::recursive_directory_iterator(viete::test::source_dir() / "src" / room)) {
      if (!is_source(entry.path())) continue;
      for (const auto& name : foreign_names(room, read_text(entry.path())))
        FAIL_CHECK(entry.path().string() << ": " << room << " may not know " << name);
    }
  }
}

TEST_CASE("names_of_other_rooms_are_found_in_code_and_not_in_comments_and_strings") {
  CHECK(foreign_names("ui", "deform::Link l; viete::render::View v;") ==
        std::vector<std::string>{"deform::Link", "render::View"});
  CHECK(foreign_names("ui", "// deform::Link\n/* mesh::x */ f(\"sym3::exp\"); scene::Tool t; std::string s;")
            .empty());
  CHECK(foreign_names("ui", "scene::deform::x; ui::mesh::y;").empty());
  CHECK(foreign_names("render", "base::Error e;").empty());
}

TEST_CASE("src_holds_no_folder_that_the_table_does_not_know") {
  for (const auto& entry : fs::directory_iterator(viete::test::source_dir() / "src")) {
    if (entry.is_directory()) CHECK_MESSAGE(rooms().count(entry.path().filename()), entry.path().string());
  }
}

TEST_CASE("planted_violations_are_found") {
  CHECK(violation("render", false, "deform/cage.h"));
  CHECK(violation("render", false, "scene/document.h"));
  CHECK(violation("ui", false, "render/view.h"));
  CHECK(violation("sym3", true, "base/error.h"));
  CHECK(violation("base", true, "mesh/surface.h"));
  CHECK(violation("mesh", true, "OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh"));
  CHECK(violation("mesh", false, "../deform/cage.h"));
  CHECK(violation("scene", false, "imgui.h"));
  CHECK(violation("deform", true, "Eigen/Dense"));
  CHECK(violation("ui", false, "backends/imgui_impl_glfw.h"));
  CHECK_FALSE(violation("mesh", false, "OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh"));
  CHECK_FALSE(violation("app", false, "render/view.h"));
  CHECK_FALSE(violation("deform", false, "sym3/exp.h"));
  CHECK_FALSE(violation("base", false, "vector"));
}

TEST_CASE("includes_are_read_from_text_and_not_from_comments") {
  const auto found = includes_of("#include <vector>\n  #  include \"a/b.h\"\n// #include \"no.h\"\nint x;\n");
  CHECK(found == std::vector<std::string>{"vector", "a/b.h"});
}
