// The README is read in one go, and its sentences at once.
#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

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

// Of prose: neither code nor tables nor headings, each item of a list by itself.
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

}  // namespace

TEST_CASE("the_readme_has_1200_words_and_no_sentence_over_30") {
  const std::string readme = text_of("README.md");
  CHECK(words_in(readme) <= 1200);
  for (const std::string& sentence : sentences_of(readme)) CHECK_MESSAGE(words_in(sentence) <= 30, sentence);
}

TEST_CASE("no_sentence_of_the_manual_is_long") {
  for (const char* chapter :
       {"README", "window", "cages", "blending", "time", "files", "command_line", "figures"}) {
    const std::string text = text_of(("assets/manual/" + std::string(chapter) + ".md").c_str());
    for (const std::string& sentence : sentences_of(text)) CHECK_MESSAGE(words_in(sentence) <= 36, sentence);
  }
}
