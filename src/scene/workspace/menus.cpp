#include "scene/workspace/menus.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

namespace viete::scene {

namespace {

struct Title {
  std::string_view title;
  std::array<std::string_view, 3> groups;
};

constexpr Title titles[] = {{"File", {"File"}},        {"Edit", {"Edit"}},
                            {"Select", {"Select"}},    {"Cage", {"Cage"}},
                            {"Tool", {"Tool"}},        {"Hand", {"Hand"}},
                            {"Probes", {"Probes"}},    {"Time", {"Poses", "Time"}},
                            {"View", {"View"}},        {"Lab", {"Method", "Blend", "Lab"}},
                            {"Help", {"Help", "Keys"}}};

bool holds(const Title& title, std::string_view group) {
  return std::ranges::find(title.groups, group) != title.groups.end();
}

// What has no menu of its own is a way to work.
std::string_view title_of(const Command& command) {
  for (const Title& title : titles) {
    if (holds(title, command.group)) return title.title;
  }
  return "Tool";
}

std::vector<Menu> make_menus() {
  std::vector<Menu> all;
  for (const Title& title : titles) {
    Menu menu{title.title, {}};
    for (const Command& command : commands()) {
      if (title_of(command) == title.title) menu.items.push_back(&command);
    }
    all.push_back(std::move(menu));
  }
  return all;
}

struct Switch {
  std::string_view command;
  bool (*is_on)(const Workspace&);
};

template <bool ViewOptions::*Option>
constexpr bool shown(const Workspace& w) {
  return w.view.*Option;
}

template <Column Which>
bool column_shown(const Workspace& w) {
  return w.view.panels && shown_columns(w.remembered.layout, w.viewport.window.x).of(Which) > 0;
}

template <SelectShape Shape>
bool armed(const Workspace& w) {
  return w.interaction.armed == Shape;
}

constexpr Switch switches[] = {
    {"select_box", armed<SelectShape::box>},
    {"select_lasso", armed<SelectShape::lasso>},
    {"select_brush", armed<SelectShape::brush>},
    {"toggle_wireframe", shown<&ViewOptions::wireframe>},
    {"toggle_model", shown<&ViewOptions::model>},
    {"toggle_deformed", shown<&ViewOptions::deformed>},
    {"toggle_cage", shown<&ViewOptions::cage>},
    {"toggle_grid", shown<&ViewOptions::grid>},
    {"toggle_axes", shown<&ViewOptions::axes>},
    {"toggle_select_visible", shown<&ViewOptions::select_visible>},
    {"toggle_ghost", shown<&ViewOptions::ghost>},
    {"toggle_error_map", shown<&ViewOptions::error_map>},
    {"toggle_theme", shown<&ViewOptions::dark>},
    {"toggle_coarse_motion", draws_coarsely},
    {"toggle_panels", shown<&ViewOptions::panels>},
    {"toggle_full_screen", [](const Workspace& w) { return w.full_screen; }},
    {"toggle_tools", column_shown<Column::tools>},
    {"toggle_lab", column_shown<Column::lab>},
    {"toggle_same_path", shown<&ViewOptions::same_path>},
    {"help", shown<&ViewOptions::help>},
    {"edit_cage", [](const Workspace& w) { return w.document.kept_pose.has_value(); }},
    {"toggle_orthographic", [](const Workspace& w) { return w.camera.pose().orthographic; }},
    {"toggle_z_up", [](const Workspace& w) { return w.camera.pose().up == UpAxis::z; }},
    {"toggle_mix_selected", [](const Workspace& w) { return w.handling.mix_selected; }},
    {"toggle_stitched", [](const Workspace& w) { return w.document.scheme.stitched(); }},
    {"tool_select", [](const Workspace& w) { return w.tool == Tool::select; }},
    {"tool_move", [](const Workspace& w) { return w.tool == Tool::move; }},
    {"tool_rotate", [](const Workspace& w) { return w.tool == Tool::rotate; }},
    {"tool_scale", [](const Workspace& w) { return w.tool == Tool::scale; }},
    {"tool_paint", [](const Workspace& w) { return w.tool == Tool::paint; }},
    {"play", [](const Workspace& w) { return w.playback.playing; }},
    {"toggle_auto_key", [](const Workspace& w) { return w.playback.auto_key; }},
    {"toggle_paths", [](const Workspace& w) { return w.playback.paths; }},
    {"toggle_straight", [](const Workspace& w) { return w.document.timeline.straight; }},
    {"toggle_timeline", [](const Workspace& w) { return w.remembered.layout.timeline; }},
};

std::string in_lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

// Its letters, in order, with others between them.
bool has_letters(std::string_view text, std::string_view letters) {
  std::size_t at = 0;
  for (const char c : text) {
    if (at < letters.size() && c == letters[at]) ++at;
  }
  return at == letters.size();
}

// How well a word fits a command; 0: not at all.
int fit(const Command& command, const std::string& word) {
  const std::string label = in_lower(command.label), group = in_lower(command.group);
  const std::string words = ' ' + label;
  if (label == word) return 120;
  if (label.starts_with(word)) return 100;
  if (words.find(' ' + word) != std::string::npos) return 80;
  if (label.find(word) != std::string::npos) return 60;
  if (group.starts_with(word)) return 50;
  if (in_lower(command.name).find(word) != std::string::npos) return 40;
  if (in_lower(command.hint).find(word) != std::string::npos) return 20;
  return has_letters(label, word) ? 10 : 0;
}

int fit_of_all(const Command& command, const std::vector<std::string>& words) {
  int sum = 1;
  for (const std::string& word : words) {
    const int one = fit(command, word);
    if (one == 0) return 0;
    sum += one;
  }
  return sum;
}

}  // namespace

std::span<const Menu> menus() {
  static const std::vector<Menu> all = make_menus();
  return all;
}

std::string_view submenu_of(const Command& command) {
  constexpr std::pair<std::string_view, std::string_view> prefixes[] = {{"view_", "Look from"},
                                                                        {"shading_", "Shading"},
                                                                        {"unit_", "Unit of the file"},
                                                                        {"pivot_", "Pivot"},
                                                                        {"axes_", "Axes"},
                                                                        {"mirror_none", "Mirror"},
                                                                        {"mirror_x", "Mirror"},
                                                                        {"mirror_y", "Mirror"},
                                                                        {"mirror_z", "Mirror"},
                                                                        {"mirror_fit", "Mirror"},
                                                                        {"soft_", "Falloff"},
                                                                        {"keys_", "Keys of"},
                                                                        {"way_", "Way"},
                                                                        {"elements_", "Elements"},
                                                                        {"weights_", "Weights"},
                                                                        {"blend_", "Blend"},
                                                                        {"side_", "Side"},
                                                                        {"easing_", "Easing"},
                                                                        {"repeat_", "After the last frame"}};
  for (const auto& [prefix, title] : prefixes) {
    if (command.name.starts_with(prefix)) return title;
  }
  return "";
}

bool is_passing(const Command& command) {
  constexpr std::string_view passing[] = {
      "stop_work",      "stop_export",     "restore_leftover", "put_off_leftover", "discard_leftover",
      "undo_discard",   "hide_discarded",  "open_cage_beside", "finish_cage",      "cancel_cage",
      "stop_benchmark", "hide_cage_offer", "show_outside",     "stop_selecting"};
  return std::ranges::find(passing, command.name) != std::end(passing);
}

std::optional<bool> is_on(const Workspace& workspace, const Command& command) {
  for (const Switch& s : switches) {
    if (s.command == command.name) return s.is_on(workspace);
  }
  return std::nullopt;
}

std::vector<const Command*> find_commands(const Workspace& workspace, std::string_view typed) {
  std::vector<std::string> words;
  std::istringstream stream(in_lower(typed));
  for (std::string word; stream >> word;) words.push_back(word);
  std::vector<std::pair<int, const Command*>> found;
  for (const Command& command : commands()) {
    if (is_passing(command) && !command.enabled(workspace)) continue;
    if (const int score = fit_of_all(command, words); score > 0) found.emplace_back(score, &command);
  }
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<const Command*> all;
  for (const auto& [score, command] : found) all.push_back(command);
  return all;
}

}  // namespace viete::scene
