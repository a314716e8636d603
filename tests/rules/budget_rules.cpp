// Size is a feature: most lines of each room of src and of each folder of tests, and most words of the texts.
// Whoever makes something smaller lowers its row. To raise one, write the reason beside it.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "rules/room_table.h"
#include "support/data.h"

namespace {

namespace fs = std::filesystem;

using Budget = std::map<std::string, std::size_t>;

// Since their last rows: deform solves shapes of large models on clusters. app and mesh give drafts colours.
const Budget lines_of_src = {
    {"analysis", 604}, {"app", 7323},      {"base", 2033},          {"bench", 4947},    {"blender", 591},
    {"cages", 3471},   {"deform", 13637},  {"deform/sparse", 1277}, {"document", 4998}, {"files", 3781},
    {"formats", 8320}, {"interact", 2494}, {"library", 924},        {"mesh", 3022},     {"platform", 966},
    {"python", 1319},  {"render", 2246},   {"sym3", 6233},          {"ui", 5975},       {"workspace", 5836},
};
constexpr std::size_t all_lines_of_src = 79'997;

// deform tests shapes of large models, app the looks of drafts.
const Budget lines_of_tests = {
    {"analysis", 284}, {"app", 1114},     {"assets", 244},   {"base", 795},      {"bench", 598},
    {"blender", 426},  {"cages", 960},    {"consumer", 505}, {"deform", 7200},   {"document", 3038},
    {"files", 2271},   {"formats", 3347}, {"fuzz", 381},     {"interact", 1456}, {"mesh", 1746},
    {"platform", 295}, {"program", 7034}, {"python", 751},   {"releases", 113},  {"render", 966},
    {"rules", 693},    {"support", 1348}, {"sym3", 3574},    {"ui", 13},         {"workspace", 2148},
};
constexpr std::size_t all_lines_of_tests = 41'300;

constexpr std::size_t words_of_readme = 896, words_of_manual_and_rooms = 14'674;

std::size_t count_lines(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return static_cast<std::size_t>(std::count(std::istreambuf_iterator<char>(in), {}, '\n'));
}

std::size_t count_words(const fs::path& file) {
  std::ifstream in(file);
  return static_cast<std::size_t>(
      std::distance(std::istream_iterator<std::string>(in), std::istream_iterator<std::string>()));
}

// Every file below a folder of the sources but those that builds leave there.
template <class Act>
void for_files(const fs::path& top, const Act& act) {
  for (fs::recursive_directory_iterator entry(top), end; entry != end; ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory() && (name.starts_with("build") || name.starts_with(".")))
      entry.disable_recursion_pending();
    if (entry->is_regular_file()) act(entry->path(), entry->path().lexically_relative(top).generic_string());
  }
}

bool is_code(const fs::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".cpp" || extension == ".h" || extension == ".py" || extension == ".sh";
}

void check(const std::string& folder, const Budget& counted, const Budget& budget, std::size_t most) {
  std::size_t total = 0;
  for (const auto& [name, lines] : counted) {
    CAPTURE(folder + "/" + name);
    REQUIRE(budget.contains(name));
    CHECK(lines <= budget.at(name));
    total += lines;
  }
  CAPTURE(folder);
  CHECK(total <= most);
}

}  // namespace

TEST_CASE("no_room_and_no_folder_of_tests_has_more_lines_than_its_budget") {
  Budget rooms, tests;
  for_files(viete::test::source_dir() / "src", [&](const fs::path& file, const std::string& path) {
    if (const auto room = viete::rules::room_of(path); room && is_code(file))
      rooms[*room] += count_lines(file);
  });
  for_files(viete::test::source_dir() / "tests", [&](const fs::path& file, const std::string& path) {
    if (is_code(file)) tests[path.substr(0, path.find('/'))] += count_lines(file);
  });
  check("src", rooms, lines_of_src, all_lines_of_src);
  check("tests", tests, lines_of_tests, all_lines_of_tests);
}

TEST_CASE("readme_manual_and_rooms_have_no_more_words_than_their_budget") {
  const fs::path top = viete::test::source_dir();
  CHECK(count_words(top / "README.md") <= words_of_readme);
  std::size_t words = count_words(top / "CHANGELOG.md");
  for (const char* folder : {"assets", "src", "third_party"})
    for_files(top / folder, [&](const fs::path& file, const std::string&) {
      if (file.extension() == ".md") words += count_words(file);
    });
  CHECK(words <= words_of_manual_and_rooms);
}
