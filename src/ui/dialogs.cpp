// The preferences, the command palette, and the list of keys and mouse buttons.
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "files/recovery.h"
#include "ui/imgui_bridge.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/command.h"

namespace viete::ui {

namespace {

void keymap_choice(const Context& ui) {
  command_choice(ui, {"keys_viete", "keys_blender", "keys_maya", "keys_viewer"},
                 static_cast<std::size_t>(ui.workspace.preferences.keymap.preset()));
}

constexpr float width = 520, label_width = 150;

// Returns the index of the chosen entry, if the user chooses one.
std::optional<std::size_t> setting(const Context& ui, const char* label, const std::string& name,
                                   std::span<const char* const> entries, std::size_t chosen,
                                   const char* tip) {
  row_label(label, label_width);
  ImGui::SetNextItemWidth(-1);
  if (!begin_list(ui, name, entries[chosen], tip)) return std::nullopt;
  std::optional<std::size_t> result;
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (list_entry(ui, entries[i], name + "/" + std::to_string(i), i == chosen, "")) result = i;
  ImGui::EndCombo();
  return result;
}

void scale_setting(const Context& ui) {
  static constexpr const char* entries[] = {"As the display", "100 %", "125 %", "150 %",
                                            "175 %",          "200 %", "250 %", "300 %"};
  static constexpr float scales[] = {0, 1, 1.25f, 1.5f, 1.75f, 2, 2.5f, 3};
  std::optional<float>& scale = ui.workspace.preferences.scale;
  const auto* nearest = std::ranges::min_element(
      scales, {}, [&](float entry) { return std::abs(entry - scale.value_or(0.0f)); });
  const auto chosen = setting(ui, "Interface scale", "preferences/scale", entries,
                              static_cast<std::size_t>(nearest - scales), "Size of text and buttons.");
  if (chosen) scale = *chosen == 0 ? std::nullopt : std::optional(scales[*chosen]);
}

void motion_setting(const Context& ui) {
  static constexpr const char* entries[] = {"Automatic: with software rendering", "Always", "Never"};
  std::optional<bool>& coarse = ui.workspace.preferences.coarse_motion;
  const std::size_t now = !coarse ? 0 : *coarse ? 1 : 2;
  const auto chosen = setting(ui, "Coarse motion", "preferences/motion", entries, now,
                              "Draw at half resolution during motion. This makes motion smoother.");
  if (chosen) coarse = *chosen == 0 ? std::nullopt : std::optional(*chosen == 1);
}

void recovered_edits(const Context& ui) {
  workspace::Workspace& w = ui.workspace;
  heading(ui, "Recovered edits");
  const std::vector<files::RecoveryFile> all = w.recovery.files;  // those that were restored once too
  if (all.empty()) return note(ui, "No recovered edits. They appear here after a crash.");
  constexpr std::size_t most_rows = 4;
  const auto rows = static_cast<float>(std::min(most_rows, all.size()));
  ImGui::BeginChild("recovered", {0, rows * (recovery_card_height + ImGui::GetStyle().ItemSpacing.y)});
  for (std::size_t i = 0; i < all.size(); ++i)
    if (recovery_card(ui, all[i], "preferences/restore/" + std::to_string(i),
                      ImGui::GetContentRegionAvail().x))
      w.panels.show_preferences = false;
  ImGui::EndChild();
  const std::size_t offered = w.recovery.offers().size();
  if (button(ui, offered < all.size() ? "Discard all but restored" : "Discard all", "preferences/discard",
             "Delete these edits, after asking."))
    w.files.question = workspace::ask_before_discarding(offered);
}

}  // namespace

void preferences_dialog(const Context& ui) {
  workspace::Workspace& w = ui.workspace;
  const document::Viewport& v = w.view.camera.viewport;
  bool open = true;
  const Dialog dialog(
      "Preferences",
      {.at = {0.5f * v.window.x, 0.5f * v.window.y}, .size = {std::min(width, v.window.x - 32), 0}},
      dialog_flags, &open);
  w.panels.show_preferences = open;
  if (!dialog) return;
  scale_setting(ui);
  row_label("Keymap", label_width);
  keymap_choice(ui);
  motion_setting(ui);
  row_label("Autosave", label_width);
  checkbox(ui, "Keep unsaved edits for recovery", "preferences/autosave", w.preferences.autosave,
           "Write unsaved edits to a recovery file after each edit. When off, closing asks to save.");
  recovered_edits(ui);
  ImGui::Dummy({0, 4});
  if (button(ui, "Close", "close_preferences", "") || key_pressed(workspace::Key::escape))
    w.panels.show_preferences = false;
}

namespace {

constexpr float palette_width = 520, palette_row = 24, palette_rows = 12;

// Draws the row of a command. Returns true if the row was clicked.
bool row(const Context& ui, const workspace::Command& command, std::size_t index, bool follow) {
  const bool highlighted = index == ui.workspace.panels.palette.highlighted;
  const bool enabled = command.enabled(ui.workspace);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const bool clicked = ImGui::InvisibleButton(std::string(command.name).c_str(), {width, palette_row});
  record(ui, "palette/" + std::string(command.name), enabled);
  const bool mouse_moves = ImGui::GetIO().MouseDelta.x != 0 || ImGui::GetIO().MouseDelta.y != 0;
  if (ImGui::IsItemHovered() && mouse_moves) ui.workspace.panels.palette.highlighted = index;
  if (highlighted && follow) ImGui::SetScrollHereY();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (highlighted) draw.AddRectFilled(at, {at.x + width, at.y + palette_row}, ui.colors.card_active, 4);
  const float y = at.y + 0.5f * (palette_row - ImGui::GetFontSize());
  const std::string label = command.label_now(ui.workspace), group(command.group);
  draw.AddText({at.x + 8, y}, enabled ? ui.colors.text : faded(ui.colors.faint, 0.7f), label.c_str());
  const float after = std::max(160.0f, ImGui::CalcTextSize(label.c_str()).x + 16);
  draw.AddText({at.x + 8 + after, y}, faded(ui.colors.faint, enabled ? 0.9f : 0.5f), group.c_str());
  text_right(ui, at.x + width - 8, workspace::text(ui.workspace.preferences.keymap.of(command).first),
             ui.colors.faint, y);
  return clicked;
}

// Shows the command's hint, or why the command is disabled. The text is always two lines high.
void explanation(const Context& ui, const workspace::Command* command) {
  if (!command) return note_within(ui, 2, " ");
  const bool enabled = command->enabled(ui.workspace);
  note_within(ui, 2, std::string(enabled ? command->hint : command->enabled.otherwise),
              enabled ? ui.colors.faint : ui.colors.warn);
  record(ui, "palette_hint");
}

// Closes the palette first, because the command may open a window with keyboard input.
void run(workspace::Workspace& w, const workspace::Command& command) {
  if (!command.enabled(w)) return;
  w.panels.palette.open = false;
  command.run(w);
}

}  // namespace

void command_palette(const Context& ui) {
  workspace::Workspace& w = ui.workspace;
  workspace::Palette& palette = w.panels.palette;
  const document::Viewport& v = w.view.camera.viewport;
  const Dialog dialog("Palette",
                      {.at = middle_at(ui, v.origin.y + 48),
                       .pivot = {0.5f, 0},
                       .size = {std::min(palette_width, v.window.x - 32), 0},
                       .border = 1},
                      fixed_flags);
  if (!dialog) return;
  const bool appeared = palette.appearing;
  const std::string before = palette.typed;
  search_field(ui, "palette_text", palette.typed, palette.appearing);
  if (palette.typed != before) palette.highlighted = 0;
  const auto found = workspace::find_commands(w, palette.typed);
  const int steps = arrow_steps();
  const auto n = static_cast<int>(std::max<std::size_t>(1, found.size()));
  palette.highlighted = static_cast<std::size_t>((static_cast<int>(palette.highlighted) + steps + n) % n);
  const float rows = std::min(palette_rows, std::floor((v.window.y - v.origin.y - 180) / palette_row));
  const workspace::Command* chosen = nullptr;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8, 0});
  ImGui::BeginChild("found", {0, std::max(3.0f, rows) * palette_row});
  for (std::size_t i = 0; i < found.size(); ++i)
    if (row(ui, *found[i], i, steps != 0)) {
      chosen = found[i];
      palette.highlighted = i;
    }
  if (found.empty()) note(ui, "No command matches.");
  ImGui::EndChild();
  ImGui::PopStyleVar();
  explanation(ui, found.empty() ? nullptr : found[palette.highlighted]);
  const bool beside = ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows);
  if (!found.empty() && enter_pressed()) chosen = found[palette.highlighted];
  if ((key_pressed(workspace::Key::escape) || beside) && !appeared) palette.open = false;
  if (chosen) run(w, *chosen);
}

namespace {

constexpr float list_width = 620, keys_width = 170, back_width = 64, mouse_width = 220;

void key_of_command(const Context& ui, const workspace::Command& command) {
  workspace::Workspace& w = ui.workspace;
  const std::string name(command.name), keys = workspace::text(w.preferences.keymap.of(command));
  const bool waits = w.view.interaction.setting_key == name;
  if (waits) ImGui::PushStyleColor(ImGuiCol_Text, ui.colors.accent);
  const std::string label = (waits ? "Press a key" : keys.empty() ? "-" : keys) + "##" + name;
  if (button(ui, label.c_str(), "key/" + name,
             waits ? "" : "Click, then press the new key. Delete removes the present key, Esc cancels.",
             {keys_width, 0}))
    w.view.interaction.setting_key = waits ? "" : name;
  if (waits) ImGui::PopStyleColor();
}

void give_back(const Context& ui, const workspace::Keymap& plain, const workspace::Command& command) {
  workspace::Keymap& keymap = ui.workspace.preferences.keymap;
  if (!keymap.changes().contains(command.name)) return;
  ImGui::SameLine();
  const std::string preset = workspace::text(plain.of(command));
  const std::string name(command.name);
  if (button(ui, ("Reset##" + name).c_str(), "key/" + name + "/reset",
             "Use the keymap's default key again: " + (preset.empty() ? "none" : preset), {back_width, 0}))
    keymap.take_back(command.name);
}

void key_row(const Context& ui, const workspace::Keymap& plain, const workspace::Command& command) {
  const float right = ImGui::GetContentRegionMax().x;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(std::string(command.label).c_str());
  hint(std::string(command.hint));
  ImGui::SameLine(right - keys_width - back_width - ImGui::GetStyle().ItemSpacing.x);
  key_of_command(ui, command);
  give_back(ui, plain, command);
}

// True for a transient command without a key, such as an answer to a question.
bool is_transient_answer(const Context& ui, const workspace::Command& command) {
  return command.passing && workspace::text(ui.workspace.preferences.keymap.of(command)).empty();
}

void mouse_rows(const Context& ui) {
  heading(ui, "Mouse");
  for (const MouseLine& line : mouse_lines(ui.workspace.preferences.keymap)) {
    ImGui::TextUnformatted(line.action.c_str());
    ImGui::SameLine(mouse_width);
    note(ui, line.what);
  }
  const workspace::About& about = ui.workspace.about;
  heading(ui, "About");
  note(ui, "Viete " + about.version + ", " + about.build + ".  Kernel: " + about.kernel +
               ".  OpenGL: " + about.renderer);
}

// Lists all commands by menu, or the matches of the search with the best match first.
void key_rows(const Context& ui) {
  const std::string& typed = ui.workspace.panels.key_list.typed;
  workspace::Keymap plain;  // the preset without user changes
  plain.set_preset(ui.workspace.preferences.keymap.preset());
  if (typed.empty()) {
    for (const workspace::Menu& menu : workspace::menus()) {
      heading(ui, std::string(menu.title).c_str());
      for (const workspace::Command* command : menu.items)
        if (!is_transient_answer(ui, *command)) key_row(ui, plain, *command);
    }
    return mouse_rows(ui);
  }
  const auto found = workspace::find_commands(ui.workspace, typed);
  for (const workspace::Command* command : found) key_row(ui, plain, *command);
  if (found.empty()) note(ui, "No command matches.");
}

// A button that resets all keys. After a reset, the button restores the user's keys until the list is closed.
void reset_all_button(const Context& ui) {
  workspace::KeyList& list = ui.workspace.panels.key_list;
  workspace::Keymap& keymap = ui.workspace.preferences.keymap;
  if (!keymap.changes().empty()) list.taken_back.reset();
  const bool brings = list.taken_back.has_value();
  const char* what =
      brings ? "Bring back your own keys that were just reset." : "Reset all keys to the keymap.";
  if (!button(ui, brings ? "Restore changes" : "Reset all", "reset_keys", what, {0, 0},
              brings || !keymap.changes().empty()))
    return;
  if (brings) {
    keymap.put(*std::exchange(list.taken_back, std::nullopt));
  } else {
    list.taken_back = keymap.changes();
    keymap.put({});
  }
}

void close_keys(workspace::Workspace& w) {
  w.panels.key_list = {};
  w.view.interaction.setting_key.clear();
}

}  // namespace

void key_list(const Context& ui) {
  workspace::Workspace& w = ui.workspace;
  const document::Viewport& v = w.view.camera.viewport;
  bool open = true;
  const Dialog dialog("Keys and mouse",
                      {.at = {0.5f * v.window.x, 0.5f * v.window.y},
                       .size = {std::min(list_width, v.window.x - 32), std::min(620.0f, v.window.y - 80)}},
                      dialog_flags, &open);
  if (!dialog) return close_keys(w);
  keymap_choice(ui);
  search_field(ui, "keys_text", w.panels.key_list.typed, w.panels.key_list.appearing);
  ImGui::BeginChild("rows", {0, -(ImGui::GetFrameHeight() + 8)});
  key_rows(ui);
  ImGui::EndChild();
  reset_all_button(ui);
  ImGui::SameLine();
  if (button(ui, "Close", "close_keys", "")) open = false;
  const bool waits = !w.view.interaction.setting_key.empty();
  // An Esc that cancels entering a key does not close the list.
  if (key_pressed(workspace::Key::escape) && !waits && !w.panels.key_list.waiting) open = false;
  w.panels.key_list.waiting = waits;
  if (!open) close_keys(w);
}

float key_question(const Context& ui, float bottom) {
  workspace::Workspace& w = ui.workspace;
  if (!w.panels.ask_keys || !w.view.options.panels || w.jobs.loading.running ||
      workspace::offers_next_step(w))
    return bottom;
  const Window window("Choose keymap",
                      {.at = middle_at(ui, bottom - 56), .pivot = {0.5f, 1}, .padding = {16, 12}},
                      card_flags);
  ImGui::TextUnformatted("Choose a keymap");
  const auto presets = workspace::choices(workspace::KeyPreset{});
  bool answered = false;
  for (std::size_t i = 0; i < presets.size(); ++i) {
    if (i > 0) ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    if (button(ui, presets[i].label.data(), "ask_keys/" + std::string(presets[i].word),
               std::string(presets[i].hint) + " You can change it later in Help, Keymap.", {72, 0})) {
      w.preferences.keymap.set_preset(static_cast<workspace::KeyPreset>(i));
      answered = true;
    }
  }
  ImGui::SameLine();
  answered |= button(ui, "x", "ask_keys/close", "Use the keymap Viete.");
  if (answered) w.panels.ask_keys = w.preferences.ask_keys = false;
  return ImGui::GetWindowPos().y + 28;
}

}  // namespace viete::ui
