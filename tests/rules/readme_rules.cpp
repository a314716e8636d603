// The README must be short. Its sentences must be short.
#include <doctest/doctest.h>

#include <fstream>
#include <iterator>

#include "rules/room_table.h"
#include "support/data.h"

namespace {

std::string text_of(const char* file) {
  std::ifstream in(viete::test::source_dir() / file, std::ios::binary);
  REQUIRE(in);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t words_in(const std::string& text) {
  std::istringstream words(text);
  return static_cast<std::size_t>(
      std::distance(std::istream_iterator<std::string>(words), std::istream_iterator<std::string>()));
}

// Returns the sentences of the prose, without code, tables and headings. Each list item is a separate text.
std::vector<std::string> sentences_of(const std::string& text) {
  std::vector<std::string> sentences(1);
  std::istringstream lines(text);
  bool in_code = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) in_code = !in_code;
    const bool prose =
        !in_code && !line.starts_with("|") && !line.starts_with("#") && !line.starts_with("    ");
    const bool begins =
        line.empty() || line.starts_with("- ") || line.starts_with("1. ") || line.starts_with("```");
    if (!prose || begins) sentences.emplace_back();
    if (!prose) continue;
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      sentences.back() += word + " ";
      const char last = word.back() == '*' && word.size() > 2 ? word[word.size() - 3] : word.back();
      if (last == '.' || last == ':') sentences.emplace_back();
    }
  }
  return sentences;
}

// Returns the cells of a table row.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream row(line);
  for (std::string cell; std::getline(row, cell, '|');) {
    const auto first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last + 1 - first));
  }
  return cells;
}

std::set<std::string> words_of(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), std::istream_iterator<std::string>()};
}

}  // namespace

TEST_CASE("no_sentence_of_the_readme_has_more_than_30_words") {
  const std::string readme = text_of("README.md");
  for (const std::string& sentence : sentences_of(readme)) CHECK_MESSAGE(words_in(sentence) <= 30, sentence);
}

TEST_CASE("the_first_picture_of_the_readme_moves_and_loads_quickly") {
  const std::string readme = text_of("README.md");
  const auto name = readme.find("](assets/pictures/") + 2, end = readme.find(')', name);
  const std::string picture = text_of(readme.substr(name, end - name).c_str());
  CHECK(picture.size() <= 1'500'000);
  CHECK(picture.starts_with("RIFF"));
  CHECK(picture.find("ANMF") != picture.npos);  // an animation frame of a WebP file
}

TEST_CASE("the_glossary_has_the_terms_of_the_manual_and_map_means_colours") {
  const std::string glossary = text_of("assets/manual/glossary.md");
  for (const char* term :
       {"cage", "map", "log space", "SRL", "method", "deformer", "stage", "frame", "pin", "shape"})
    CHECK_MESSAGE(glossary.find("\n|" + std::string(term) + "|") != glossary.npos, term);
  for (const auto& entry : std::filesystem::directory_iterator(viete::test::source_dir() / "assets/manual")) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".md")) continue;
    const std::string text = text_of(("assets/manual/" + name).c_str());
    for (const char* other : {"affine map", "cage's map", "blended map"})
      CHECK_MESSAGE(text.find(other) == text.npos, name << " calls a transformation a map");
  }
}

TEST_CASE("no_sentence_of_the_manual_is_long") {
  for (const char* chapter : {"README", "window", "cages", "blending", "time", "shapes", "files",
                              "command_line", "figures", "glossary"}) {
    const std::string text = text_of(("assets/manual/" + std::string(chapter) + ".md").c_str());
    for (const std::string& sentence : sentences_of(text)) CHECK_MESSAGE(words_in(sentence) <= 36, sentence);
  }
}

TEST_CASE("the_readme_of_the_sources_has_the_table_of_rooms") {
  std::map<std::string, std::set<std::string>> written, rules;
  std::istringstream lines(text_of("src/README.md"));
  for (std::string line; std::getline(lines, line) && !line.starts_with("**");) {
    const auto cells = cells_of(line);
    if (cells.size() == 4 && cells[1].starts_with("`"))
      written[cells[1].substr(1, cells[1].size() - 2)] = words_of(cells[2]);
  }
  for (const auto& [name, room] : viete::rules::rooms()) rules[name] = room.knows;
  CHECK(written == rules);
}

TEST_CASE("the_readme_of_a_room_names_its_headers_and_no_others") {
  namespace fs = std::filesystem;
  static const std::regex named(R"(`([\w-]+\.h)`)");
  for (const auto& [name, rules] : viete::rules::rooms()) {
    const fs::path folder = viete::test::source_dir() / "src" / name;
    const std::string readme = text_of(("src/" + name + "/README.md").c_str());
    std::istringstream lines(readme);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("- **"))  // one line per term
        CHECK_MESSAGE(line.find("**", line.find("**:") + 2) == line.npos, name << "/README.md: " << line);
    std::set<std::string> spoken_of;
    for (std::sregex_iterator at(readme.begin(), readme.end(), named), end; at != end; ++at)
      spoken_of.insert((*at)[1]);
    for (const auto& header : spoken_of)
      CHECK_MESSAGE(fs::exists(folder / header), name << "/README.md: there is no " << header);
    if (name == "sym3" || name == "python") continue;  // their READMEs name only public headers
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string file = entry.path().filename().string();
      if (file.ends_with(".h") && !file.ends_with("-inl.h"))
        CHECK_MESSAGE(spoken_of.count(file), name << "/README.md does not say what " << file << " is");
    }
  }
}
