#include "ui/panels.h"

#include <imgui_internal.h>

#include <array>
#include <filesystem>
#include <initializer_list>
#include <string>

#include "base/os.h"
#include "ui/system_fonts.h"

namespace viete::ui {

namespace {

constexpr ImU32 rgb(unsigned hex, unsigned alpha = 255) {
  return IM_COL32(hex >> 16 & 255, hex >> 8 & 255, hex & 255, alpha);
}

ImVec4 rgba(unsigned hex, float alpha = 1) {
  ImVec4 c = ImGui::ColorConvertU32ToFloat4(rgb(hex));
  c.w = alpha;
  return c;
}

// Font folders of distributions, of a Flatpak runtime, and beside a portable program.
std::array<std::filesystem::path, 3> font_folders() {
  return {"/usr/share/fonts", "/app/share/fonts", base::os::program_file().parent_path() / "share" / "fonts"};
}

// Ranges of ImGui, pairs of the first and last character, that end with 0.
using Ranges = std::vector<ImWchar>;

Ranges ranges_of(const std::set<char32_t>& characters, Ranges ranges = {}) {
  for (const char32_t c : characters) ranges.insert(ranges.end(), 2, static_cast<ImWchar>(c));
  ranges.push_back(0);
  return ranges;
}

ImFont* add_first(std::initializer_list<const char*> files, float size, const Ranges& ranges) {
  for (const char* file : files)
    for (const auto& folder : font_folders()) {
      std::error_code ignored;
      if (std::filesystem::exists(folder / file, ignored))
        return ImGui::GetIO().Fonts->AddFontFromFileTTF((folder / file).string().c_str(), size, nullptr,
                                                        ranges.data());
    }
  return nullptr;
}

// Adds characters that the last added font lacks to this font.
void merge(const std::vector<SystemFont>& others, float size, const Fonts& fonts) {
  for (std::size_t i = 0; i < others.size(); ++i) {
    ImFontConfig config;
    config.MergeMode = true;
    config.FontNo = static_cast<int>(others[i].face);
    ImGui::GetIO().Fonts->AddFontFromFileTTF(others[i].file.string().c_str(), size, &config,
                                             fonts.ranges[i + 1].data());
  }
}

void set_sizes(ImGuiStyle& s) {
  s.WindowPadding = {12, 8};
  s.FramePadding = {8, 3};
  s.ItemSpacing = {8, 5};
  s.ItemInnerSpacing = {6, 4};
  s.WindowRounding = 0;
  s.FrameRounding = 4;
  s.GrabRounding = 4;
  s.PopupRounding = 4;
  s.ScrollbarSize = 10;
  s.ScrollbarRounding = 5;
  s.WindowBorderSize = 0;
  s.PopupBorderSize = 1;
  s.DisabledAlpha = 0.45f;
}

struct Tones {
  unsigned window, frame, hover, active, text, faint, accent, line;
};

constexpr Tones dark_tones{0x1c2027, 0x2a3039, 0x353c47, 0x404956, 0xe4e7ec, 0x9aa3b0, 0x3fb8af, 0x333a45};
constexpr Tones light_tones{0xfbfbfc, 0xe9ecf0, 0xdde2e8, 0xcfd6de, 0x1f252d, 0x586372, 0x0f766e, 0xd5dae1};

}  // namespace

Fonts add_fonts(float scale, bool builtin_only, const std::set<char32_t>& characters) {
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  Fonts fonts;
  const std::vector<SystemFont> others = fonts_with(characters);
  fonts.ranges.push_back(ranges_of(characters, {0x20, 0xff, 0x2010, 0x2027}));
  for (const SystemFont& other : others) fonts.ranges.push_back(ranges_of(other.characters));
  io.FontGlobalScale = 1 / scale;
  if (!builtin_only) {
    const auto add = [&](std::initializer_list<const char*> files, float size) {
      ImFont* font = add_first(files, size * scale, fonts.ranges.front());
      if (font) merge(others, size * scale, fonts);
      return font;
    };
    fonts.text = add({"opentype/inter/Inter-Regular.otf", "truetype/inter/Inter-Regular.ttf",
                      "truetype/dejavu/DejaVuSans.ttf"},
                     15);
    fonts.strong = add({"opentype/inter/Inter-SemiBold.otf", "truetype/inter/Inter-SemiBold.ttf",
                        "truetype/dejavu/DejaVuSans-Bold.ttf"},
                       15);
    fonts.numbers = add(
        {"truetype/jetbrains-mono/JetBrainsMono-Regular.ttf", "truetype/dejavu/DejaVuSansMono.ttf"}, 13.5f);
  }
  if (!fonts.text) {
    ImFontConfig config;
    config.SizePixels = 13 * scale;
    config.OversampleH = config.OversampleV = 1;
    config.PixelSnapH = true;
    fonts.text = io.Fonts->AddFontDefault(&config);
    merge(others, config.SizePixels, fonts);
  }
  io.FontDefault = fonts.text;
  if (!fonts.strong) fonts.strong = fonts.text;
  if (!fonts.numbers) fonts.numbers = fonts.text;
  return fonts;
}

void apply_style(bool dark) {
  ImGuiStyle& s = ImGui::GetStyle();
  set_sizes(s);
  if (dark) {
    ImGui::StyleColorsDark();
  } else {
    ImGui::StyleColorsLight();
  }
  const Tones& t = dark ? dark_tones : light_tones;
  s.Colors[ImGuiCol_Text] = rgba(t.text);
  s.Colors[ImGuiCol_TextDisabled] = rgba(t.faint);
  s.Colors[ImGuiCol_WindowBg] = rgba(t.window, 0.985f);
  s.Colors[ImGuiCol_PopupBg] = rgba(t.window, 0.985f);
  s.Colors[ImGuiCol_MenuBarBg] = rgba(t.window);
  s.Colors[ImGuiCol_FrameBg] = s.Colors[ImGuiCol_Button] = rgba(t.frame);
  s.Colors[ImGuiCol_FrameBgHovered] = s.Colors[ImGuiCol_ButtonHovered] = rgba(t.hover);
  s.Colors[ImGuiCol_FrameBgActive] = s.Colors[ImGuiCol_ButtonActive] = rgba(t.active);
  s.Colors[ImGuiCol_Header] = rgba(t.frame, 0);
  s.Colors[ImGuiCol_HeaderHovered] = rgba(t.hover, 0.6f);
  s.Colors[ImGuiCol_HeaderActive] = rgba(t.active, 0.6f);
  s.Colors[ImGuiCol_CheckMark] = s.Colors[ImGuiCol_SliderGrab] = s.Colors[ImGuiCol_SliderGrabActive] =
      s.Colors[ImGuiCol_DragDropTarget] = rgba(t.accent);
  s.Colors[ImGuiCol_Separator] = s.Colors[ImGuiCol_Border] = rgba(t.line);
  s.Colors[ImGuiCol_SeparatorHovered] = s.Colors[ImGuiCol_SeparatorActive] = rgba(t.accent, 0.6f);
  s.Colors[ImGuiCol_TitleBg] = s.Colors[ImGuiCol_TitleBgActive] = s.Colors[ImGuiCol_TitleBgCollapsed] =
      rgba(t.frame);
  s.Colors[ImGuiCol_ResizeGrip] = rgba(t.active, 0.6f);
  s.Colors[ImGuiCol_ResizeGripHovered] = s.Colors[ImGuiCol_ResizeGripActive] = rgba(t.accent);
  s.Colors[ImGuiCol_NavHighlight] = rgba(t.accent, 0.6f);
  s.Colors[ImGuiCol_ScrollbarBg] = rgba(t.window, 0);
  s.Colors[ImGuiCol_ScrollbarGrab] = rgba(t.active);
  s.Colors[ImGuiCol_ScrollbarGrabHovered] = s.Colors[ImGuiCol_ScrollbarGrabActive] = rgba(t.faint);
  s.Colors[ImGuiCol_PlotHistogram] = rgba(t.accent);
  s.Colors[ImGuiCol_ModalWindowDimBg] = dark ? rgba(0x0c0f13, 0.5f) : rgba(0x2d3641, 0.25f);
  s.Colors[ImGuiCol_TextSelectedBg] = rgba(t.accent, 0.35f);
}

Palette palette(bool dark) {
  const Tones& t = dark ? dark_tones : light_tones;
  Palette p{};
  p.text = rgb(t.text);
  p.faint = rgb(t.faint);
  p.accent = rgb(t.accent);
  p.good = rgb(dark ? 0x7ccf8a : 0x1f7a3a);
  p.warn = rgb(dark ? 0xffb224 : 0x95590a);
  p.bad = rgb(dark ? 0xff7a6b : 0xb3261e);
  p.card = rgb(t.frame);
  p.card_hover = rgb(t.hover);
  p.card_active = dark ? rgb(0x24423f) : rgb(0xd6efec);
  p.line = rgb(t.line);
  p.model = rgb(dark ? 0xd2bfa8 : 0xc9b69f);
  p.axis[0] = rgb(dark ? 0xf2685f : 0xd23b36);
  p.axis[1] = rgb(dark ? 0x86cc55 : 0x3f8f1c);
  p.axis[2] = rgb(dark ? 0x64a3f7 : 0x2b6bd1);
  p.on_axis = rgb(dark ? 0x15181d : 0xffffff);
  p.neutral = rgb(dark ? 0xe4e7ec : 0x2d3641);
  p.highlight = rgb(dark ? 0xffc24a : 0xf08a00);
  p.halo = dark ? rgb(0x0c0f13, 150) : rgb(0xffffff, 190);
  return p;
}

// Softened colours of the palette of Okabe and Ito, which colour-blind people can distinguish.
ImU32 stage_color(workspace::Stage stage) {
  static constexpr std::array<unsigned, workspace::stage_count> colors = {
      0x8c9bb0, 0x6a7f9c, 0x4a90c2, 0xe69f3c, 0x3fb09a, 0x6fc3df,
      0xe07b54, 0x8f7fd1, 0xcf5f7a, 0xc58bb5, 0xb0a45a, 0x7fae6b};
  return rgb(colors[static_cast<std::size_t>(stage)]);
}

namespace {

using Characters = std::set<char32_t>;

// Adds the characters after Latin-1, which the fonts always have.
void add(Characters& all, const std::string& text) {
  for (const char *at = text.data(), *end = at + text.size(); at < end;) {
    unsigned character = static_cast<unsigned char>(*at);
    at += character < 0x80 ? 1 : ImTextCharFromUtf8(&character, at, end);
    if (character > 0xff && character <= IM_UNICODE_CODEPOINT_MAX &&
        character != IM_UNICODE_CODEPOINT_INVALID)
      all.insert(character);
  }
}

template <class List, class Text>
void add_each(Characters& all, const List& list, Text text) {
  for (const auto& entry : list) add(all, entry.*text);
}

void add_files(Characters& all, const workspace::Workspace& w) {
  add(all, w.document.model().path.string());
  add(all, w.document.cage_file().path.string());
  add(all, w.document.cage_beside().string());
  add(all, w.files.saved.session.string());
  for (const workspace::RecentFile& recent : w.preferences.recent) {
    add(all, recent.file.string());
    add(all, recent.cage.string());
  }
  for (const files::RecoveryFile& kept : w.recovery.files) {
    add(all, kept.name);
    add(all, kept.folder.string());
  }
}

void add_browser(Characters& all, const workspace::FileBrowser& browser) {
  if (!browser.open) return;
  add_each(all, browser.entries, &workspace::FileBrowser::Entry::name);
  add(all, browser.folder.string());
  for (const std::string* text : {&browser.path, &browser.problem, &browser.filter, &browser.warned})
    add(all, *text);
}

}  // namespace

std::set<char32_t> shown_characters(const workspace::Workspace& w) {
  Characters all;
  add_files(all, w);
  add_browser(all, w.files.browser);
  add_each(all, w.document.library().poses, &document::NamedPose::name);
  add_each(all, w.document.groups().sets, &document::NamedSet::name);
  add_each(all, w.messages.all(), &workspace::Message::text);
  for (const auto* work : {&w.jobs.loading, &w.jobs.binding, &w.jobs.exporting}) add(all, work->what);
  if (const auto& question = w.files.question) {
    for (const std::string* text : {&question->title, &question->text, &question->why}) add(all, *text);
  }
  for (const ImWchar typed : ImGui::GetIO().InputQueueCharacters)
    if (typed > 0xff) all.insert(typed);
  return all;
}

}  // namespace viete::ui
