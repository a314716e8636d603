#include "ui/panels.h"

#include <imgui.h>
#include <optional>
#include <string>
#include <utility>

#include "ui/imgui_bridge.h"
#include "ui/widgets.h"
#include "workspace/command.h"
#include "workspace/pointer.h"

namespace viete::ui {

namespace {

bool matches(const workspace::Shortcut& shortcut, const ImGuiIO& io) {
  return shortcut.key != workspace::Key::none && shortcut.ctrl == io.KeyCtrl &&
         shortcut.shift == io.KeyShift && shortcut.alt == io.KeyAlt && key_pressed(shortcut.key);
}

std::optional<workspace::Shortcut> pressed_shortcut() {
  const ImGuiIO& io = ImGui::GetIO();
  for (const auto& [key, name] : workspace::all_keys())
    if (key_pressed(key)) return workspace::Shortcut{key, io.KeyCtrl, io.KeyShift, io.KeyAlt};
  return std::nullopt;
}

// Assigns the pressed key to a command. Esc cancels, Delete removes the key.
void set_key(workspace::Workspace& workspace) {
  const auto pressed = pressed_shortcut();
  if (!pressed) return;
  const std::string name = std::exchange(workspace.view.interaction.setting_key, "");
  const workspace::Command* const command = workspace::find_command(name);
  if (!command || *pressed == workspace::Shortcut{workspace::Key::escape}) return;
  const bool none = *pressed == workspace::Shortcut{workspace::Key::delete_key};
  workspace::Keymap& keymap = workspace.preferences.keymap;
  std::string losers;
  for (const workspace::Command* loser :
       none ? std::vector<const workspace::Command*>{} : keymap.losers(name, *pressed))
    losers += (losers.empty() ? " It was taken from \"" : ", \"") + std::string(loser->label) + '"';
  keymap.change(name, none ? workspace::Shortcut{} : *pressed);
  workspace.messages.info('"' + std::string(command->label) + "\" now has " +
                          (none ? "no key." : "the key " + workspace::text(*pressed) + '.') + losers +
                          (losers.empty() ? "" : "."));
}

// Shortcuts are disabled during a mouse gesture, because they could change the dragged objects.
void run_shortcuts(workspace::Workspace& workspace, const workspace::Pointer& pointer) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || ImGui::IsAnyItemActive() || types_into_slider(workspace) || pointer.active())
    return;
  for (const auto& command : workspace::commands()) {
    const workspace::Shortcuts keys = workspace.preferences.keymap.of(command);
    if (!matches(keys.first, io) && !matches(keys.second, io)) continue;
    if (!command.enabled(workspace)) continue;  // another command may have this key in another mode
    return command.run(workspace);
  }
}

// If `keys` is false, the input contains no keys: a dialog, a menu or a widget uses the keyboard.
workspace::PointerInput pointer_input(bool keys) {
  const ImGuiIO& io = ImGui::GetIO();
  workspace::PointerInput input;
  input.position = {io.MousePos.x, io.MousePos.y};
  for (int i = 0; i < 3; ++i) input.down[i] = io.MouseDown[i];
  input.double_click = ImGui::IsMouseDoubleClicked(0);
  input.wheel = io.MouseWheel;
  input.shift = io.KeyShift;
  input.ctrl = io.KeyCtrl;
  input.alt = io.KeyAlt;
  input.over_view = !io.WantCaptureMouse && ImGui::IsMousePosValid();
  input.escape = keys && key_pressed(workspace::Key::escape);
  if (io.WantTextInput || !keys) return input;
  input.enter = enter_pressed();
  input.backspace = key_pressed(workspace::Key::backspace);
  for (const ImWchar c : io.InputQueueCharacters)
    if (c > 0 && c < 128) input.typed += static_cast<char>(c);
  return input;
}

}  // namespace

void handle_input(workspace::Workspace& workspace, workspace::Pointer& pointer) {
  if (!workspace.view.interaction.setting_key.empty()) return set_key(workspace);
  const bool keys = !take_escape(workspace) && !is_popup_open();
  pointer.frame(workspace, pointer_input(keys));
  if (keys) run_shortcuts(workspace, pointer);
  workspace.panels.hovered_weight.reset();
}

}  // namespace viete::ui
