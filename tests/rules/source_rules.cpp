// Source text must be ASCII. The first line of a header must state its purpose.
#include <doctest/doctest.h>

#include <fstream>
#include <regex>

#include "support/data.h"

namespace fs = std::filesystem;

namespace {

template <class Visit>
void for_each_source(Visit visit) {
  for (const char* top : {"src", "tests", "shaders", "third_party", "assets"})
    for (const auto& entry : fs::recursive_directory_iterator(viete::test::source_dir() / top)) {
      const auto e = entry.path().extension();
      if (e == ".h" || e == ".cpp" || e == ".vert" || e == ".frag" || e == ".glsl" || e == ".cmake" ||
          e == ".sh" || e == ".inl") {
        std::ifstream in(entry.path(), std::ios::binary);
        visit(entry.path(), std::string(std::istreambuf_iterator<char>(in), {}));
      }
    }
}

}  // namespace

TEST_CASE("sources_are_ascii") {
  for_each_source([](const fs::path& path, const std::string& text) {
    std::size_t line = 1;
    for (const char c : text) {
      if (c == '\n') ++line;
      if (static_cast<unsigned char>(c) >= 128) {
        FAIL_CHECK(path.string() << ":" << line << ": a character outside ASCII");
        break;
      }
    }
  });
}

TEST_CASE("headers_say_in_their_first_line_what_they_are_for") {
  for_each_source([](const fs::path& path, const std::string& text) {
    if (path.extension() != ".h") return;
    const bool is_c = text.find("extern \"C\"") != std::string::npos;  // the header is for C and C++
    CHECK_MESSAGE(text.rfind(is_c ? "/* " : "// ", 0) == 0, path.string());
    const bool is_kernel_text = path.string().ends_with("-inl.h");  // included once per instruction set
    const char* guard = is_c             ? "#ifndef VIETE_"
                        : is_kernel_text ? "defined(HWY_TARGET_TOGGLE)"
                                         : "#pragma once";
    CHECK_MESSAGE(text.find(guard) != std::string::npos, path.string());
  });
}

TEST_CASE("no_comment_begins_with_a_relative_clause") {
  const std::regex opening("\\n *(///?<?|#) (Of|What|Where|Those|That of) [^\\n]*");
  for_each_source([&](const fs::path& path, const std::string& text) {
    std::smatch found;
    const std::string all = "\n" + text;
    if (std::regex_search(all, found, opening)) FAIL_CHECK(path.string() << ":" << found.str());
  });
}
