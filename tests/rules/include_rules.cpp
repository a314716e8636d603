// The table of rooms must allow every #include in src.
#include <doctest/doctest.h>

#include <fstream>

#include "rules/room_table.h"
#include "support/data.h"

namespace fs = std::filesystem;
using viete::rules::find_cycle;
using viete::rules::foreign_names;
using viete::rules::includes_of;
using viete::rules::room_of;
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

// Calls use(room, path, text) for each file of a room. Paths are relative to src.
template <class Use>
void for_sources(const Use& use) {
  const fs::path src = viete::test::source_dir() / "src";
  for (const auto& entry : fs::recursive_directory_iterator(src)) {
    const std::string path = entry.path().lexically_relative(src).generic_string();
    const auto room = room_of(path);
    if (room && is_source(entry.path())) use(*room, path, read_text(entry.path()));
  }
}

std::string unit_of(const std::string& path) {
  return fs::path(path).replace_extension().generic_string();
}

}  // namespace

TEST_CASE("every_include_in_src_is_allowed_by_the_table_of_rooms") {
  std::map<std::string, int> files;
  for_sources([&](const std::string& room, const std::string& path, const std::string& text) {
    ++files[room];
    for (const auto& include : includes_of(text)) {
      const auto problem = violation(room, !path.ends_with(".cpp"), include);
      CHECK_MESSAGE(!problem, path, ": ", problem.value_or(""));
    }
  });
  for (const auto& [room, rules] : rooms()) CHECK_MESSAGE((files[room] > 0) != rules.in_python, room);
}

TEST_CASE("no_file_in_src_names_what_its_room_may_not_know") {
  for_sources([&](const std::string& room, const std::string& path, const std::string& text) {
    for (const auto& name : foreign_names(room, text))
      FAIL_CHECK(path << ": " << room << " may not know " << name);
  });
}

TEST_CASE("only_base_os_knows_the_operating_system") {
  for_sources([&](const std::string&, const std::string& path, const std::string& text) {
    if (path.starts_with("base/os_")) return;
    for (const auto& include : includes_of(text))
      CHECK_MESSAGE(!viete::rules::is_of_system(include), path, ": ", include);
    for (const char* name : {"_WIN32", "__linux__", "__APPLE__", "/proc/", "getenv("})
      CHECK_MESSAGE((text.find(name) == text.npos || path.starts_with("sym3/")), path, ": ", name);
  });
  CHECK(viete::rules::is_of_system("unistd.h"));
  CHECK(viete::rules::is_of_system("sys/stat.h"));
  CHECK(viete::rules::is_of_system("windows.h"));
  CHECK_FALSE(viete::rules::is_of_system("vector"));
  CHECK_FALSE(viete::rules::is_of_system("base/os.h"));
}

TEST_CASE("no_sources_include_each_other_in_a_circle") {
  std::map<std::string, std::set<std::string>> includes;
  for_sources([&](const std::string&, const std::string& path, const std::string& text) {
    auto& own = includes[unit_of(path)];
    for (const auto& include : includes_of(text)) own.insert(unit_of(include));
  });
  CHECK(includes.size() > 300);
  std::string circle;
  for (const auto& unit : find_cycle(includes)) circle += unit + " -> ";
  CHECK_MESSAGE(circle.empty(), circle);
}

TEST_CASE("circles_are_found") {
  CHECK(find_cycle({{"a", {"b", "c"}}, {"b", {"c"}}, {"c", {"vector"}}}).empty());
  CHECK(find_cycle({{"a", {"a", "b"}}, {"b", {"c"}}, {"c", {"d"}}, {"d", {"b"}}}) ==
        std::vector<std::string>{"b", "c", "d"});
}

TEST_CASE("names_of_other_rooms_are_found_in_code_and_not_in_comments_and_strings") {
  CHECK(foreign_names("ui", "pose::Stage l; viete::render::View v;") ==
        std::vector<std::string>{"pose::Stage", "render::View"});
  CHECK(
      foreign_names("ui", "// pose::Stage\n/* mesh::x */ f(\"sym3::exp\"); interact::Tool t; std::string s;")
          .empty());
  CHECK(foreign_names("ui", "document::deform::x; ui::mesh::y;").empty());
  CHECK(foreign_names("render", "base::Error e;").empty());
}

TEST_CASE("src_holds_no_folder_that_the_table_does_not_know") {
  for (const auto& entry : fs::directory_iterator(viete::test::source_dir() / "src")) {
    if (!entry.is_directory()) continue;
    const std::string folder = entry.path().filename().string();
    CHECK_MESSAGE(rooms().count(folder), folder);
  }
}

TEST_CASE("planted_violations_are_found") {
  CHECK(violation("render", false, "pose/cage.h"));
  CHECK(violation("render", false, "document/document.h"));
  CHECK(violation("ui", false, "render/view.h"));
  CHECK(violation("sym3", true, "base/error.h"));
  CHECK(violation("base", true, "mesh/surface.h"));
  CHECK(violation("mesh", true, "OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh"));
  CHECK(violation("mesh", false, "../pose/cage.h"));
  CHECK(violation("interact", false, "imgui.h"));
  CHECK(violation("interact", false, "files/session.h"));
  CHECK(violation("document", false, "workspace/workspace.h"));
  CHECK(violation("mesh", false, "formats/read.h"));
  CHECK(violation("sparse", false, "pose/cage.h"));
  CHECK(violation("pose", false, "deform/frame_deformer.h"));
  CHECK(violation("document", false, "deform/frame_deformer.h"));
  CHECK(violation("interact", false, "weights/binding.h"));
  CHECK(violation("deform", true, "Eigen/Dense"));
  CHECK(violation("ui", false, "backends/imgui_impl_glfw.h"));
  CHECK_FALSE(violation("cages", false, "OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh"));
  CHECK_FALSE(violation("app", false, "render/view.h"));
  CHECK_FALSE(violation("deform", false, "sym3/exp.h"));
  CHECK_FALSE(violation("base", false, "vector"));
  CHECK_FALSE(violation("interact", false, "document/document.h"));
}

TEST_CASE("includes_are_read_from_text_and_not_from_comments") {
  const auto found = includes_of("#include <vector>\n  #  include \"a/b.h\"\n// #include \"no.h\"\nint x;\n");
  CHECK(found == std::vector<std::string>{"vector", "a/b.h"});
}

TEST_CASE("comments_name_headers_that_are_there") {
  static const std::regex named(R"(\b[a-z_0-9]+(?:/[a-z_0-9]+)+\.h\b)");
  const fs::path src = viete::test::source_dir() / "src";
  for_sources([&](const std::string&, const std::string& path, const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      const auto comment = line.find("//");
      if (comment == std::string::npos) continue;
      const std::string words = line.substr(comment);
      for (std::sregex_iterator at(words.begin(), words.end(), named), end; at != end; ++at) {
        const std::string header = (*at)[0];
        if (room_of(header)) CHECK_MESSAGE(fs::exists(src / header), path, " names ", header);
      }
    }
  });
}
