#include "ui/input.h"

#include <imgui.h>

#include "scene/commands.h"
#include "ui/imgui_bridge.h"

namespace viete::ui {

namespace {

bool matches(const scene::Shortcut& shortcut, const ImGuiIO& io) {
  return shortcut.key != scene::Key::none && shortcut.ctrl == io.KeyCtrl && shortcut.shift == io.KeyShift &&
         !io.KeyAlt && key_pressed(shortcut.key);
}

// While the mouse is at work keys are its own: they must not change what it holds.
void run_shortcuts(scene::Workspace& workspace, const scene::Pointer& pointer) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || pointer.active() || workspace.question) return;
  for (const auto& command : scene::commands()) {
    if (!matches(command.shortcut, io) && !matches(command.alternative, io)) continue;
    if (!command.enabled(workspace)) continue;  // a key may do another thing in another mode
    return command.run(workspace);
  }
}

// A question that waits for its answer has the keyboard to itself.
scene::PointerInput pointer_input(bool keys) {
  const ImGuiIO& io = ImGui::GetIO();
  scene::PointerInput input;
  input.position = {io.MousePos.x, io.MousePos.y};
  for (int i = 0; i < 3; ++i) input.down[i] = io.MouseDown[i];
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
  const bool keys = !workspace.question;
  if (keys && workspace.view.help && key_pressed(scene::Key::escape)) workspace.view.help = false;
  pointer.frame(workspace, pointer_input(keys));
  run_shortcuts(workspace, pointer);
}

}  // namespace viete::ui
