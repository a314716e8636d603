#include "scene/workspace/preferences.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/error.h"
#include "scene/document/range.h"
#include "scene/files/json_file.h"

namespace viete::scene {

namespace {

constexpr std::size_t index(Column column) {
  return static_cast<std::size_t>(column);
}

constexpr Column other(Column column) {
  return column == Column::tools ? Column::methods : Column::tools;
}

// The chosen width, limited to the room.
float fitted(float width, float room) {
  return std::min(width, std::max(PanelLayout::least_width, room));
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
    const float kept = both && column == layout.last ? PanelLayout::least_width : taken;  // for the other
    shown[index(column)] = fitted(layout.width[index(column)], room - kept);
  }
  return {shown[0], shown[1]};
}

float column_height(const Viewport& viewport) {
  return std::max(1.0f, viewport.window.y - viewport.origin.y - PanelLayout::status_height);
}

Viewport view_between(const PanelLayout& layout, const glm::vec2& window, bool panels, float notice) {
  if (!panels) return {window, {0, notice}, glm::max(glm::vec2(1), window - glm::vec2(0, notice))};
  const ColumnWidths columns = shown_columns(layout, window.x);
  const float below = PanelLayout::status_height + (layout.timeline ? PanelLayout::timeline_height : 0);
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
using nlohmann::ordered_json;

namespace {

fs::path from_root(const fs::path& path) {
  std::error_code ignored;
  return path.empty() ? path : fs::absolute(path, ignored).lexically_normal();
}

RecentFile recent_of(const JsonReader& json) {
  RecentFile recent{json.at("file").path(), {}};
  if (const auto cage = json.find("cage")) recent.cage = cage->path();
  return recent;
}

ordered_json to_json(const RecentFile& recent) {
  ordered_json json = {{"file", path_json(recent.file)}};
  if (!recent.cage.empty()) json["cage"] = path_json(recent.cage);
  return json;
}

constexpr const char* column_names[] = {"tools", "methods"};

ordered_json to_json(const PanelLayout& layout) {
  ordered_json json;
  for (std::size_t i = 0; i < 2; ++i)
    json[column_names[i]] = {{"width", layout.width[i]}, {"folded", layout.folded[i]}};
  json["last"] = column_names[static_cast<std::size_t>(layout.last)];
  json["timeline"] = layout.timeline;
  json["sections"] = layout.sections;
  return json;
}

PanelLayout layout_of(const JsonReader& json) {
  PanelLayout layout;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto column = json.find(column_names[i]);
    if (!column) continue;
    const double width = column->at("width").number();
    layout.width[i] =
        static_cast<float>(std::clamp<double>(width, PanelLayout::least_width, PanelLayout::largest_width));
    layout.folded[i] = column->at("folded").boolean();
  }
  if (const auto last = json.find("last"); last && last->text() == column_names[1])
    layout.last = Column::methods;
  if (const auto timeline = json.find("timeline")) layout.timeline = timeline->boolean();
  if (const auto sections = json.find("sections")) {
    for (const std::string& title : sections->keys()) layout.sections[title] = sections->at(title).boolean();
  }
  return layout;
}

std::optional<glm::ivec2> size_of(const JsonReader& json) {
  const auto [width, height] = json.numbers<2>();
  if (!is_window(width, height)) return std::nullopt;
  return glm::ivec2(width, height);
}

// Ignores unknown commands, which a newer version may have written.
Keymap keymap_of(const JsonReader& json) {
  Keymap keymap;
  if (const auto preset = json.find("preset"))
    keymap.set_preset(value_of_word<KeyPreset>(preset->text()).value_or(keymap.preset()));
  if (const auto changed = json.find("changed")) {
    for (const std::string& command : changed->keys()) {
      if (const auto key = shortcut_of(changed->at(command).text())) keymap.change(command, *key);
    }
  }
  return keymap;
}

ordered_json to_json(const Keymap& keymap) {
  ordered_json json = {{"preset", entry_of(keymap.preset()).word}};
  for (const auto& [command, key] : keymap.changes()) json["changed"][command] = text(key);
  return json;
}

void put_arrangement(ordered_json& json, const Preferences& preferences) {
  json["hints"] = preferences.hints;
  json["ask_keys"] = preferences.ask_keys;
  json["dark"] = preferences.dark;
  json["layout"] = to_json(preferences.layout);
  json["keys"] = to_json(preferences.keymap);
}

void take_arrangement(Preferences& preferences, const JsonReader& json) {
  if (const auto hints = json.find("hints")) preferences.hints = hints->boolean();
  if (const auto ask = json.find("ask_keys")) preferences.ask_keys = ask->boolean();
  if (const auto dark = json.find("dark")) preferences.dark = dark->boolean();
  if (const auto layout = json.find("layout")) preferences.layout = layout_of(*layout);
  if (const auto keys = json.find("keys")) preferences.keymap = keymap_of(*keys);
}

// Appends older entries that are not in the list.
void append_missing(Preferences& to, const std::vector<RecentFile>& more) {
  for (const auto& file : more) {
    if (to.recent.size() >= Preferences::most) return;
    if (std::find(to.recent.begin(), to.recent.end(), file) == to.recent.end()) to.recent.push_back(file);
  }
}

// A damaged file has no entries worth keeping.
std::vector<RecentFile> recent_in(const fs::path& file) {
  try {
    return read_preferences(file).recent;
  } catch (const base::Error&) {
    return {};
  }
}

}  // namespace

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
  const nlohmann::json whole = read_json(file);
  const JsonReader json(whole, file.string());
  std::vector<RecentFile> recent;
  if (const auto list = json.find("recent")) {
    for (std::size_t i = 0; i < list->size(); ++i) recent.push_back(recent_of(list->item(i)));
  }
  append_missing(preferences, recent);
  if (const auto folder = json.find("folder")) preferences.folder = folder->path();
  take_arrangement(preferences, json);
  if (const auto coarse = json.find("coarse_motion")) preferences.coarse_motion = coarse->boolean();
  if (const auto window = json.find("window")) preferences.window = size_of(*window);
  return preferences;
}

void write_preferences(const fs::path& file, const Preferences& preferences) {
  Preferences all = preferences;
  append_missing(all, recent_in(file));
  ordered_json json = {{"format", "viete remembered"}, {"version", 1}};
  json["recent"] = ordered_json::array();
  for (const auto& entry : all.recent) json["recent"].push_back(to_json(entry));
  json["folder"] = path_json(all.folder);
  if (all.coarse_motion) json["coarse_motion"] = *all.coarse_motion;
  if (all.window) json["window"] = {all.window->x, all.window->y};
  put_arrangement(json, all);
  base::replace_file(file, readable(json, file), base::Durability::process);
}

}  // namespace viete::scene
