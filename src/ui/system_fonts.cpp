#include "ui/system_fonts.h"

#ifdef VIETE_FONTCONFIG

#include <fontconfig/fontconfig.h>

#include <memory>
#include <optional>

namespace viete::ui {

namespace {

template <auto destroy>
struct Destroy {
  template <class T>
  void operator()(T* object) const {
    destroy(object);
  }
};
using Pattern = std::unique_ptr<FcPattern, Destroy<FcPatternDestroy>>;
using CharSet = std::unique_ptr<FcCharSet, Destroy<FcCharSetDestroy>>;
using FontSet = std::unique_ptr<FcFontSet, Destroy<FcFontSetDestroy>>;

// Scalable fonts that have the character, the best first.
FontSet candidates(char32_t character) {
  const Pattern wanted(FcPatternCreate());
  const CharSet characters(FcCharSetCreate());
  FcCharSetAddChar(characters.get(), character);
  FcPatternAddCharSet(wanted.get(), FC_CHARSET, characters.get());
  FcPatternAddBool(wanted.get(), FC_SCALABLE, FcTrue);
  FcPatternAddString(wanted.get(), FC_FAMILY, reinterpret_cast<const FcChar8*>("sans-serif"));
  FcConfigSubstitute(nullptr, wanted.get(), FcMatchPattern);
  FcDefaultSubstitute(wanted.get());
  FcResult result = FcResultMatch;
  return FontSet(FcFontSort(nullptr, wanted.get(), FcTrue, nullptr, &result));
}

// Dear ImGui reads TrueType and OpenType files, but no variable or bitmap fonts.
bool is_readable(FcPattern* font) {
  FcChar8* format = nullptr;
  FcBool outline = FcFalse;
  if (FcPatternGetBool(font, FC_OUTLINE, 0, &outline) != FcResultMatch || !outline) return false;
  if (FcPatternGetString(font, FC_FONTFORMAT, 0, &format) != FcResultMatch) return false;
  const std::string_view name = reinterpret_cast<const char*>(format);
  return name == "TrueType" || name == "CFF";
}

std::optional<SystemFont> font_with(char32_t character, const std::set<char32_t>& all) {
  const FontSet fonts = candidates(character);
  for (int i = 0; fonts && i < fonts->nfont; ++i) {
    FcPattern* font = fonts->fonts[i];
    FcCharSet* has = nullptr;
    FcChar8* file = nullptr;
    int face = 0;
    if (FcPatternGetCharSet(font, FC_CHARSET, 0, &has) != FcResultMatch ||
        !FcCharSetHasChar(has, character) || !is_readable(font) ||
        FcPatternGetString(font, FC_FILE, 0, &file) != FcResultMatch)
      continue;
    FcPatternGetInteger(font, FC_INDEX, 0, &face);
    SystemFont found{reinterpret_cast<const char*>(file), static_cast<unsigned>(face) & 0xffffU, {}};
    for (const char32_t c : all)
      if (FcCharSetHasChar(has, c)) found.characters.insert(c);
    return found;
  }
  return std::nullopt;
}

}  // namespace

std::vector<SystemFont> fonts_with(std::set<char32_t> characters) {
  std::vector<SystemFont> fonts;
  while (!characters.empty()) {
    auto font = font_with(*characters.begin(), characters);
    characters.erase(characters.begin());
    if (!font) continue;
    for (const char32_t c : font->characters) characters.erase(c);
    fonts.push_back(*std::move(font));
  }
  return fonts;
}

}  // namespace viete::ui

#else

namespace viete::ui {

std::vector<SystemFont> fonts_with(std::set<char32_t>) {
  return {};
}

}  // namespace viete::ui

#endif
