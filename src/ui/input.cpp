#include "ui/input.h"

#include <imgui.h>
#include <optional>
#include <string>
#include <utility>

#include "scene/workspace/command.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

bool matches(const scene::Shortcut& shortcut, const ImGuiIO& io) {
  return shortcut.key != scene::Key::none && shortcut.ctrl == io.KeyCtrl && shortcut.shift == io.KeyShift &&
         shortcut.alt == io.KeyAlt && key_pressed(shortcut.key);
}

std::optional<scene::Shortcut> pressed_shortcut() {
  const ImGuiIO& io = ImGui::GetIO();
  for (const scene::Key key : scene::all_keys()) {
    if (key_pressed(key)) return scene::Shortcut{key, io.KeyCtrl, io.KeyShift, io.KeyAlt};
  }
  return std::nullopt;
}

// Esc keeps the key, Delete removes it.
void set_key(scene::Workspace& workspace) {
  const auto pressed = pressed_shortcut();
  if (!pressed) return;
  const std::string name = std::exchange(workspace.interaction.setting_key, "");
  const scene::Command* const command = scene::find_command(name);
  if (!command || *pressed == scene::Shortcut{scene::Key::escape}) return;
  const bool none = *pressed == scene::Shortcut{scene::Key::delete_key};
  scene::Keymap& keymap = workspace.preferences.keymap;
  std::string losers;
  for (const scene::Command* loser :
       none ? std::vector<const scene::Command*>{} : keymap.losers(name, *pressed))
    losers += (losers.empty() ? " It was taken from \"" : ", \"") + std::string(loser->label) + '"';
  keymap.change(name, none ? scene::Shortcut{} : *pressed);
  workspace.messages.info('"' + std::string(command->label) + "\" has " +
                          (none ? "no key now." : "the key " + scene::text(*pressed) + " now.") + losers +
                          (losers.empty() ? "" : "."));
}

// Shortcuts are disabled during a mouse gesture: they must not change its objects.
void run_shortcuts(scene::Workspace& workspace, const scene::Pointer& pointer) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || ImGui::IsAnyItemActive() || types_into_slider(workspace) || pointer.active() ||
      workspace.question)
    return;
  for (const auto& command : scene::commands()) {
    const scene::Shortcuts keys = workspace.preferences.keymap.of(command);
    if (!matches(keys.first, io) && !matches(keys.second, io)) continue;
    if (!command.enabled(workspace)) continue;  // another command may have this key in another mode
    return command.run(workspace);
  }
}

// A modal question captures the keyboard.
scene::PointerInput pointer_input(bool keys) {
  const ImGuiIO& io = ImGui::GetIO();
  scene::PointerInput input;
  input.position = {io.MousePos.x, io.MousePos.y};
  for (int i = 0; i < 3; ++i) input.down[i] = io.MouseDown[i];
  input.double_click = ImGui::IsMouseDoubleClicked(0);
  input.wheel = io.MouseWheel;
  input.shift = io.KeyShift;
  input.ctrl = io.KeyCtrl;
  input.alt = io.KeyAlt;
  input.over_view = !io.WantCaptureMouse && ImGui::IsMousePosValid();
  input.escape = keys && key_pressed(scene::Key::escape);
  if (io.WantTextInput || !keys) return input;
  input.enter = key_pressed(scene::Key::enter) || key_pressed(scene::Key::pad_enter);
  input.backspace = key_pressed(scene::Key::backspace);
  for (const ImWchar c : io.InputQueueCharacters) {
    if (c > 0 && c < 128) input.typed += static_cast<char>(c);
  }
  return input;
}

}  // namespace

void handle_input(scene::Workspace& workspace, scene::Pointer& pointer) {
  if (!workspace.interaction.setting_key.empty()) return set_key(workspace);
  const bool escaped = take_escape(workspace), keys = !workspace.question && !escaped;
  if (keys && workspace.view.help && key_pressed(scene::Key::escape)) workspace.view.help = false;
  pointer.frame(workspace, pointer_input(keys));
  if (!escaped) run_shortcuts(workspace, pointer);
}

}  // namespace viete::ui
