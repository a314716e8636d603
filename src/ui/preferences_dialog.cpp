#include <algorithm>
#include <cmath>
#include <span>

#include "files/recovery.h"
#include "ui/imgui_bridge.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

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
  const document::Viewport& v = w.view.viewport;
  bool open = true;
  const Dialog dialog(
      "Preferences",
      {.at = {0.5f * v.window.x, 0.5f * v.window.y}, .size = {std::min(width, v.window.x - 32), 0}},
      dialog_flags, &open);
  w.panels.show_preferences = open;
  if (!dialog) return;
  scale_setting(ui);
  row_label("Keymap", label_width);
  command_choice(ui, {"keys_viete", "keys_blender", "keys_maya", "keys_viewer"},
                 static_cast<std::size_t>(w.preferences.keymap.preset()));
  motion_setting(ui);
  row_label("Autosave", label_width);
  checkbox(ui, "Keep unsaved edits for recovery", "preferences/autosave", w.preferences.autosave,
           "Write unsaved edits to a recovery file after each edit. When off, closing asks to save.");
  recovered_edits(ui);
  ImGui::Dummy({0, 4});
  if (button(ui, "Close", "close_preferences", "") || key_pressed(workspace::Key::escape))
    w.panels.show_preferences = false;
}

}  // namespace viete::ui
