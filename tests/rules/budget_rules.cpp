// Size is a feature: most lines of src and of tests, and most words of the texts. Readability decides within
// these.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

#include "support/data.h"

namespace {

namespace fs = std::filesystem;

// The targets are 80,800 lines of src and 42,000 of tests.
constexpr std::size_t most_lines_of_src = 90'480, most_lines_of_tests = 48'590;
constexpr std::size_t most_lines_of_a_room = 10'000, most_files_of_a_room = 45, most_lines_of_a_file = 600;
constexpr std::size_t most_words_of_readme = 935, most_words_of_manual_and_rooms = 18'360;

std::size_t count_lines(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return static_cast<std::size_t>(std::count(std::istreambuf_iterator<char>(in), {}, '\n'));
}

std::size_t count_words(const fs::path& file) {
  std::ifstream in(file);
  return static_cast<std::size_t>(
      std::distance(std::istream_iterator<std::string>(in), std::istream_iterator<std::string>()));
}

// Every file below a folder of the sources except those that builds leave there.
template <class Act>
void for_files(const fs::path& top, const Act& act) {
  for (fs::recursive_directory_iterator entry(top), end; entry != end; ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory() && (name.starts_with("build") || name.starts_with(".")))
      entry.disable_recursion_pending();
    if (entry->is_regular_file()) act(entry->path());
  }
}

bool is_code(const fs::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".cpp" || extension == ".h" || extension == ".py" || extension == ".sh";
}

std::size_t lines_of_code(const char* folder) {
  std::size_t lines = 0;
  for_files(viete::test::source_dir() / folder, [&](const fs::path& file) {
    if (is_code(file)) lines += count_lines(file);
  });
  return lines;
}

}  // namespace

TEST_CASE("src_and_tests_have_no_more_lines_than_their_budgets") {
  CHECK(lines_of_code("src") <= most_lines_of_src);
  CHECK(lines_of_code("tests") <= most_lines_of_tests);
}

TEST_CASE("rooms_and_files_are_of_a_size_that_can_be_read") {
  std::map<std::string, std::size_t> files, lines;
  const fs::path src = viete::test::source_dir() / "src";
  for_files(src, [&](const fs::path& file) {
    if (file.extension() != ".cpp" && file.extension() != ".h") return;
    const std::string room = file.lexically_relative(src).begin()->string();
    const std::size_t count = count_lines(file);
    CHECK_MESSAGE(count <= most_lines_of_a_file, file.string(), ": split it");
    ++files[room];
    lines[room] += count;
  });
  for (const auto& [room, count] : files) {
    CHECK_MESSAGE(count <= most_files_of_a_room, room);
    CHECK_MESSAGE(lines[room] <= most_lines_of_a_room, room);
  }
}

TEST_CASE("readme_manual_and_rooms_have_no_more_words_than_their_budget") {
  const fs::path top = viete::test::source_dir();
  CHECK(count_words(top / "README.md") <= most_words_of_readme);
  std::size_t words = count_words(top / "CHANGELOG.md");
  for (const char* folder : {"assets", "src", "third_party"})
    for_files(top / folder, [&](const fs::path& file) {
      if (file.extension() == ".md") words += count_words(file);
    });
  CHECK(words <= most_words_of_manual_and_rooms);
}
