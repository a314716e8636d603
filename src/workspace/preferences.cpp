#include "workspace/preferences.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "document/range.h"
#include "files/json_codec.h"

namespace viete::workspace {

namespace {

constexpr std::size_t index(Column column) {
  return static_cast<std::size_t>(column);
}

constexpr Column other(Column column) {
  return column == Column::tools ? Column::methods : Column::tools;
}

}  // namespace

ColumnWidths shown_columns(const PanelLayout& layout, float window_width) {
  const float room = window_width - PanelLayout::least_view;
  const bool both = !layout.folded[0] && !layout.folded[1] && room >= 2 * PanelLayout::least_width;
  std::array<float, 2> shown{};
  for (const Column column : {layout.last, other(layout.last)}) {
    const bool alone = column == layout.last || layout.is_folded(other(column));
    if (layout.is_folded(column) || !(both || alone)) continue;
    const float taken = shown[index(other(column))];
    const float kept =
        both && column == layout.last ? PanelLayout::least_width : taken;  // room for the other column
    shown[index(column)] =
        std::min(layout.width[index(column)], std::max(PanelLayout::least_width, room - kept));
  }
  return {shown[0], shown[1]};
}

float column_height(const document::Viewport& viewport) {
  return std::max(1.0f, viewport.window.y - viewport.origin.y - PanelLayout::status_height);
}

document::Viewport view_between(const PanelLayout& layout, const glm::vec2& window, bool panels,
                                float notice) {
  if (!panels) return {window, {0, notice}, glm::max(glm::vec2(1), window - glm::vec2(0, notice))};
  const ColumnWidths columns = shown_columns(layout, window.x);
  const float below = PanelLayout::status_height + layout.timeline_height();
  const float above = PanelLayout::menu_height + notice;
  const glm::vec2 covered(columns.tools + columns.methods, above + below);
  return {window, {columns.tools, above}, glm::max(glm::vec2(1), window - covered)};
}

void toggle_column(PanelLayout& layout, Column column, float window_width) {
  const bool shown = shown_columns(layout, window_width).of(column) > 0;
  layout.folded[index(column)] = shown;
  layout.last = shown ? other(column) : column;
}

void set_width(PanelLayout& layout, Column column, float width, float window_width) {
  const float taken = shown_columns(layout, window_width).of(other(column));
  const float room = std::max(PanelLayout::least_width, window_width - taken - PanelLayout::least_view);
  layout.width[index(column)] =
      std::clamp(width, PanelLayout::least_width, std::min(room, PanelLayout::largest_width));
}

namespace fs = std::filesystem;

namespace {

fs::path from_root(const fs::path& path) {
  std::error_code ignored;
  return path.empty() ? path : fs::absolute(path, ignored).lexically_normal();
}

constexpr std::array<std::string_view, 2> column_words = {"tools", "methods"};

}  // namespace

// Templates in json_codec.h find these functions by argument-dependent lookup.

static void code(const files::JsonField& f, RecentFile& recent) {
  f.needed("file", recent.file);
  f.unless({}, "cage", recent.cage);
}

static void code_sections(const files::JsonField& f, std::map<std::string, bool>& sections) {
  if (!f.reads()) {
    f.out() = sections;
    return;
  }
  for (const std::string& title : f.in().keys()) sections[title] = f.in().at(title).boolean();
}

static void code(const files::JsonField& f, PanelLayout& layout) {
  for (std::size_t i = 0; i < 2; ++i) {
    const auto column = f.child(column_words[i].data());
    if (!column) continue;
    column->needed("width", layout.width[i],
                   files::Limits{PanelLayout::least_width, PanelLayout::largest_width});
    column->needed("folded", layout.folded[i]);
  }
  if (const auto last = f.child("last")) code_listed(*last, layout.last, column_words);
  f.member("timeline", layout.timeline);
  if (const auto sections = f.child("sections")) code_sections(*sections, layout.sections);
}

// Ignores unknown keys: a newer version may have written the file.
static void code(const files::JsonField& f, Keymap& keymap) {
  KeyPreset preset = keymap.preset();
  f.member("preset", preset);
  if (!f.reads()) {
    for (const auto& [command, key] : keymap.changes()) f.out()["changed"][command] = text(key);
    return;
  }
  keymap.set_preset(preset);
  const auto changed = f.in().find("changed");
  if (!changed) return;
  for (const std::string& command : changed->keys())
    if (const auto key = shortcut_of(changed->at(command).text())) keymap.change(command, *key);
}

static void code(const files::JsonField& f, Preferences& preferences) {
  f.member("recent", preferences.recent, Preferences::most);
  f.member("folder", preferences.folder);
  f.unless({}, "coarse_motion", preferences.coarse_motion);
  f.unless(true, "autosave", preferences.autosave);
  f.unless({}, "scale", preferences.scale, files::Limits{0.5, 4});
  f.unless({}, "window", preferences.window);
  f.member("hints", preferences.hints);
  f.member("ask_keys", preferences.ask_keys);
  f.member("dark", preferences.dark);
  f.member("layout", preferences.layout);
  f.member("keys", preferences.keymap);
}

void Preferences::add(const RecentFile& file) {
  const RecentFile entry{from_root(file.file), from_root(file.cage)};
  std::erase(recent, entry);
  recent.insert(recent.begin(), entry);
  if (recent.size() > most) recent.resize(most);
}

Preferences read_preferences(const fs::path& file) {
  Preferences preferences;
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return preferences;
  const nlohmann::json whole = files::read_json(file);
  code(files::JsonField(files::JsonReader(whole, file.string())), preferences);
  return preferences;
}

void write_preferences(const fs::path& file, const Preferences& preferences) {
  Preferences all = preferences;
  if (all.window && !document::is_window(all.window->x, all.window->y)) all.window.reset();
  nlohmann::ordered_json json = {{"format", "viete remembered"}, {"version", 1}};
  code(files::JsonField(json), all);
  base::replace_file(file, files::readable(json, file), base::Durability::process);
}

}  // namespace viete::workspace
