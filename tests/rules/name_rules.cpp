// Sources of a room may be compiled separately or as one unit: names at namespace level must be unambiguous
// in a room, and each source must include the headers of the names it uses.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "rules/declarations.h"
#include "rules/room_table.h"
#include "support/data.h"

namespace fs = std::filesystem;
using namespace viete::rules;

namespace {

using Texts = std::map<std::string, std::string>;  // keyed by path

Texts texts_below(const std::string& top) {
  Texts texts;
  for (const auto& entry : fs::recursive_directory_iterator(viete::test::source_dir() / top)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    const auto name = entry.path().lexically_relative(viete::test::source_dir() / top).string();
    texts[name] = {std::istreambuf_iterator<char>(in), {}};
  }
  return texts;
}

std::string home_of(const std::string& file) {
  return file.substr(0, file.find('/'));
}

bool clash(const Declared& a, const Declared& b) {
  if (a.kind != b.kind) return true;
  const bool by_meaning = a.kind == Declared::Kind::function || a.kind == Declared::Kind::alias;
  return !by_meaning || (a.kind == Declared::Kind::function) == (a.meaning == b.meaning);
}

// "deform: turn in branches.cpp and translation_log.cpp".
std::set<std::string> clashes(const Texts& texts) {
  std::map<std::pair<std::string, std::string>, std::vector<std::pair<std::string, Declared>>> known;
  std::set<std::string> found;
  for (const auto& [file, text] : texts) {
    if (!file.ends_with(".cpp")) continue;
    for (const Head& head : heads_of(plain_code(text))) {
      const auto declared = head.anonymous ? declared_by(head.text) : std::nullopt;
      if (!declared) continue;
      auto& others = known[{home_of(file) + head.space, declared->name}];
      for (const auto& [other, its] : others)
        if (other != file && clash(its, *declared))
          found.insert(declared->name + " in " + other + " and " + file);
      others.emplace_back(file, *declared);
    }
  }
  return found;
}

using Files = std::set<std::string>;

void add_included(const Texts& texts, const std::string& file, Files& all) {
  const auto text = texts.find(file);
  if (text == texts.end() || !all.insert(file).second) return;
  for (const auto& include : includes_of(text->second)) add_included(texts, include, all);
}

bool mentions(const std::string& code, const std::string& name) {
  return std::regex_search(code, std::regex("\\b" + name + "\\b"));
}

// Declared as a member, parameter, variable or own type.
bool declares(const std::string& code, const std::string& name) {
  static const std::regex no_type(R"(\b(?:return|else|case|throw|new|const)\b)");
  return std::regex_search(std::regex_replace(code, no_type, ""),
                           std::regex("(?:\\b(?:class|typename)\\s+|\\w::|[\\w>]\\s*[&*]?\\s+[&*]?)" + name +
                                      "\\s*[=({;,):>\\[]"));
}

// Uses a name that is declared only in headers (of this room or a room qualified with it) that are not
// included.
std::set<std::string> missing_includes(const Texts& texts) {
  std::map<std::string, Files> homes;
  std::map<std::string, std::string> codes;
  for (const auto& [file, text] : texts) {
    codes[file] = plain_code(text);
    if (!file.ends_with(".h") || file.ends_with("-inl.h")) continue;
    for (const Head& head : heads_of(codes[file]))
      if (const auto declared = declared_by(head.text)) homes[declared->name].insert(file);
  }
  static const std::regex used(R"((^|[^\w:.>]|\s)(?:(\w+)::)?([A-Za-z]\w+)(?=\s*(\(?)))");
  std::set<std::string> found;
  for (const auto& [file, code] : codes) {
    Files included;
    add_included(texts, file, included);
    const auto is_included = [&](const std::string& home) { return included.count(home) > 0; };
    std::set<std::string> seen;
    for (std::sregex_iterator at(code.begin(), code.end(), used), end; at != end; ++at) {
      const std::string room = (*at)[2].matched ? (*at)[2].str() : home_of(file), name = (*at)[3];
      const auto home = homes.find(name);
      const bool called = (*at)[4].length() > 0 || std::isupper(static_cast<unsigned char>(name[0]));
      if (!called || home == homes.end() || !seen.insert(room + name).second) continue;
      const auto of_room = [&](const std::string& header) { return home_of(header) == room; };
      if (std::ranges::none_of(home->second, of_room) || std::ranges::any_of(home->second, is_included))
        continue;
      const auto names_it = [&](const std::string& header) {
        return header != file && mentions(codes[header], name);
      };
      if (std::ranges::any_of(included, names_it) || (!(*at)[2].matched && declares(code, name))) continue;
      found.insert(file + " uses " + name + " of " + *home->second.begin());
    }
  }
  return found;
}

}  // namespace

TEST_CASE("a_name_in_an_anonymous_namespace_means_one_thing_in_a_room_and_in_its_tests") {
  for (const auto& found : clashes(texts_below("src"))) FAIL_CHECK(found);
  Texts tests = texts_below("tests");
  std::erase_if(tests, [](const auto& text) { return home_of(text.first) == "fuzz"; });  // separate programs
  for (const auto& found : clashes(tests)) FAIL_CHECK(found);
}

TEST_CASE("each_source_includes_what_it_names_of_other_files") {
  for (const auto& found : missing_includes(texts_below("src"))) FAIL_CHECK(found);
}

TEST_CASE("planted_clashes_and_missing_includes_are_found") {
  const auto in_two = [](const std::string& a, const std::string& b) {
    const auto source = [](const std::string& text) {
      return "namespace viete {\nnamespace {\n" + text + "\n}\n}\n";
    };
    return clashes({{"mesh/a.cpp", source(a)}, {"mesh/b.cpp", source(b)}}).size();
  };
  CHECK(in_two("constexpr double least = 1;", "constexpr double least = 2;") == 1);
  CHECK(in_two("constexpr double least = 1;", "int least(int a) { return a; }") == 1);
  CHECK(in_two("struct Part {};", "enum class Part { a };") == 1);
  CHECK(in_two("void f(const Point& p) {}", "int f(const Point& other) { return 1; }") == 1);
  CHECK(in_two("using Numbers = std::vector<int>;", "using Numbers = std::vector<char>;") == 1);
  CHECK(in_two("using Numbers = std::vector<int>;", "using Numbers =\n    std::vector<int>;") == 0);
  CHECK(in_two("void f(const Point& p) {}", "void f(const Point& p, int n) {}") == 0);
  CHECK(in_two("void f() { int least = '{'; }", "int least = 10'000; // }") == 0);
  CHECK(clashes({{"mesh/a.cpp", "namespace { int x = 1; }"}, {"deform/a.cpp", "namespace { int x = 1; }"}})
            .empty());

  Texts texts{{"mesh/area.h", "namespace viete::mesh {\ndouble area(int n);\nstruct Area { int a; };\n}\n"},
              {"mesh/b.h", ""}};
  const auto lacking = [&](const std::string& file, const std::string& text) {
    texts[file] = text;
    const std::size_t count = missing_includes(texts).size();
    texts.erase(file);
    return count;
  };
  CHECK(lacking("mesh/b.cpp", "#include \"mesh/b.h\"\ndouble f() { return area(3); }\n") == 1);
  CHECK(lacking("deform/b.cpp", "double f() { return mesh::area(3); }\n") == 1);
  CHECK(lacking("mesh/b.cpp", "#include \"mesh/area.h\"\ndouble f() { return area(3); }\n") == 0);
  CHECK(lacking("mesh/b.cpp", "double f(double area) { return area; } // area(3)\n") == 0);
  CHECK(lacking("mesh/b.cpp", "double f(const X& x) { return x.area(3); }\n") == 0);
}
