#include "ui/system_fonts.h"

#include <doctest/doctest.h>

using namespace viete::ui;

TEST_CASE("fonts_of_the_system_have_the_wanted_characters_and_no_others") {
  const std::set<char32_t> wanted{U'\u0414', U'\u03b1', U'\u4e2d', U'\ud55c', U'\u0639'};
  std::set<char32_t> found;
  for (const SystemFont& font : fonts_with(wanted)) {
    CHECK(std::filesystem::exists(font.file));
    CHECK_FALSE(font.characters.empty());
    for (const char32_t c : font.characters) {
      CHECK(wanted.contains(c));
      found.insert(c);
    }
  }
#ifdef VIETE_FONTCONFIG
  CHECK(found.contains(U'\u0414'));  // every desktop font has Cyrillic
#endif
  CHECK(fonts_with({}).empty());
  CHECK(fonts_with({U'\uf8fe'}).size() <= 1);  // for private use: usually no font
}
