#include "ui/system_fonts.h"

#ifdef VIETE_FONTCONFIG

#include <fontconfig/fontconfig.h>

#include <memory>
#include <optional>

#include "base/error.h"
#include "base/os.h"

namespace viete::ui {

namespace {

// The library fontconfig, loaded at run time: the program also starts on systems without it.
struct Fontconfig : base::os::Library {
  Fontconfig() : Library({"libfontconfig.so.1"}) {}
#define VIETE_FONTCONFIG_FUNCTION(name) \
  decltype(&::name) name = reinterpret_cast<decltype(&::name)>(find(#name))
  VIETE_FONTCONFIG_FUNCTION(FcCharSetAddChar);
  VIETE_FONTCONFIG_FUNCTION(FcCharSetCreate);
  VIETE_FONTCONFIG_FUNCTION(FcCharSetDestroy);
  VIETE_FONTCONFIG_FUNCTION(FcCharSetHasChar);
  VIETE_FONTCONFIG_FUNCTION(FcConfigSubstitute);
  VIETE_FONTCONFIG_FUNCTION(FcDefaultSubstitute);
  VIETE_FONTCONFIG_FUNCTION(FcFontSetDestroy);
  VIETE_FONTCONFIG_FUNCTION(FcFontSort);
  VIETE_FONTCONFIG_FUNCTION(FcPatternAddBool);
  VIETE_FONTCONFIG_FUNCTION(FcPatternAddCharSet);
  VIETE_FONTCONFIG_FUNCTION(FcPatternAddString);
  VIETE_FONTCONFIG_FUNCTION(FcPatternCreate);
  VIETE_FONTCONFIG_FUNCTION(FcPatternDestroy);
  VIETE_FONTCONFIG_FUNCTION(FcPatternGetBool);
  VIETE_FONTCONFIG_FUNCTION(FcPatternGetCharSet);
  VIETE_FONTCONFIG_FUNCTION(FcPatternGetInteger);
  VIETE_FONTCONFIG_FUNCTION(FcPatternGetString);
#undef VIETE_FONTCONFIG_FUNCTION
};

// Null if fontconfig is not installed.
const Fontconfig* fontconfig() {
  static const std::unique_ptr<const Fontconfig> loaded = []() -> std::unique_ptr<const Fontconfig> {
    try {
      return std::make_unique<Fontconfig>();
    } catch (const base::Error&) {
      return nullptr;
    }
  }();
  return loaded.get();
}

template <auto destroy>
struct Destroy {
  template <class T>
  void operator()(T* object) const {
    (fontconfig()->*destroy)(object);
  }
};
using Pattern = std::unique_ptr<FcPattern, Destroy<&Fontconfig::FcPatternDestroy>>;
using CharSet = std::unique_ptr<FcCharSet, Destroy<&Fontconfig::FcCharSetDestroy>>;
using FontSet = std::unique_ptr<FcFontSet, Destroy<&Fontconfig::FcFontSetDestroy>>;

// Scalable fonts that have the character, the best first.
FontSet candidates(const Fontconfig& fc, char32_t character) {
  const Pattern wanted(fc.FcPatternCreate());
  const CharSet characters(fc.FcCharSetCreate());
  fc.FcCharSetAddChar(characters.get(), character);
  fc.FcPatternAddCharSet(wanted.get(), FC_CHARSET, characters.get());
  fc.FcPatternAddBool(wanted.get(), FC_SCALABLE, FcTrue);
  fc.FcPatternAddString(wanted.get(), FC_FAMILY, reinterpret_cast<const FcChar8*>("sans-serif"));
  fc.FcConfigSubstitute(nullptr, wanted.get(), FcMatchPattern);
  fc.FcDefaultSubstitute(wanted.get());
  FcResult result = FcResultMatch;
  return FontSet(fc.FcFontSort(nullptr, wanted.get(), FcTrue, nullptr, &result));
}

// Dear ImGui reads TrueType and OpenType files, but no variable or bitmap fonts.
bool is_readable(const Fontconfig& fc, FcPattern* font) {
  FcChar8* format = nullptr;
  FcBool outline = FcFalse;
  if (fc.FcPatternGetBool(font, FC_OUTLINE, 0, &outline) != FcResultMatch || !outline) return false;
  if (fc.FcPatternGetString(font, FC_FONTFORMAT, 0, &format) != FcResultMatch) return false;
  const std::string_view name = reinterpret_cast<const char*>(format);
  return name == "TrueType" || name == "CFF";
}

std::optional<SystemFont> font_with(const Fontconfig& fc, char32_t character, const std::set<char32_t>& all) {
  const FontSet fonts = candidates(fc, character);
  for (int i = 0; fonts && i < fonts->nfont; ++i) {
    FcPattern* font = fonts->fonts[i];
    FcCharSet* has = nullptr;
    FcChar8* file = nullptr;
    int face = 0;
    if (fc.FcPatternGetCharSet(font, FC_CHARSET, 0, &has) != FcResultMatch ||
        !fc.FcCharSetHasChar(has, character) || !is_readable(fc, font) ||
        fc.FcPatternGetString(font, FC_FILE, 0, &file) != FcResultMatch)
      continue;
    fc.FcPatternGetInteger(font, FC_INDEX, 0, &face);
    SystemFont found{reinterpret_cast<const char*>(file), static_cast<unsigned>(face) & 0xffffU, {}};
    for (const char32_t c : all)
      if (fc.FcCharSetHasChar(has, c)) found.characters.insert(c);
    return found;
  }
  return std::nullopt;
}

}  // namespace

std::vector<SystemFont> fonts_with(std::set<char32_t> characters) {
  std::vector<SystemFont> fonts;
  const Fontconfig* const fc = fontconfig();
  while (fc != nullptr && !characters.empty()) {
    auto font = font_with(*fc, *characters.begin(), characters);
    characters.erase(characters.begin());
    if (!font) continue;
    for (const char32_t c : font->characters) characters.erase(c);
    fonts.push_back(*std::move(font));
  }
  return fonts;
}

}  // namespace viete::ui

#else

#include "base/os.h"

namespace viete::ui {

namespace {

// Fonts of Windows, and the characters that they have.
struct CharacterRange {
  char32_t first, last;
  const char* file;
};
constexpr CharacterRange windows_fonts[] = {
    {0x0100, 0x07ff, "segoeui.ttf"}, {0x0900, 0x0dff, "Nirmala.ttf"},  {0x0e00, 0x0e7f, "leelawui.ttf"},
    {0x1100, 0x11ff, "malgun.ttf"},  {0x3040, 0x30ff, "msgothic.ttc"}, {0x3400, 0x9fff, "msyh.ttc"},
    {0xac00, 0xd7a3, "malgun.ttf"},  {0xff00, 0xffef, "msgothic.ttc"}};

}  // namespace

std::vector<SystemFont> fonts_with(std::set<char32_t> characters) {
  const std::filesystem::path folder = std::filesystem::path(base::os::variable("WINDIR")) / "Fonts";
  std::vector<SystemFont> fonts;
  for (const CharacterRange& range : windows_fonts) {
    SystemFont font{folder / range.file, 0, {}};
    for (const char32_t c : characters)
      if (c >= range.first && c <= range.last) font.characters.insert(c);
    std::error_code ignored;
    if (!font.characters.empty() && std::filesystem::exists(font.file, ignored)) fonts.push_back(font);
  }
  return fonts;
}

}  // namespace viete::ui

#endif
