// Hides differences between the versions of Dear ImGui in distributions (1.86 to 1.92).
#pragma once

#include <imgui.h>

#include "workspace/command.h"

namespace viete::ui {

/// ImGui's key for a key code (see workspace::Key), or 0 if the program does not use the key.
inline int imgui_key(int code) {
#if IMGUI_VERSION_NUM < 18700
  return code;
#else
  constexpr int named[] = {ImGuiKey_Escape,    ImGuiKey_Enter,   ImGuiKey_Tab,        ImGuiKey_Backspace,
                           ImGuiKey_Insert,    ImGuiKey_Delete,  ImGuiKey_RightArrow, ImGuiKey_LeftArrow,
                           ImGuiKey_DownArrow, ImGuiKey_UpArrow, ImGuiKey_PageUp,     ImGuiKey_PageDown,
                           ImGuiKey_Home,      ImGuiKey_End};
  if (code >= 256 && code < 256 + IM_ARRAYSIZE(named)) return named[code - 256];
  constexpr int runs[][3] = {{'A', 'Z', ImGuiKey_A},     {'0', '9', ImGuiKey_0},
                             {290, 301, ImGuiKey_F1},    {320, 335, ImGuiKey_Keypad0},
                             {',', '/', ImGuiKey_Comma}, {'=', '=', ImGuiKey_Equal},
                             {' ', ' ', ImGuiKey_Space}};
  for (const auto& [first, last, key] : runs)
    if (code >= first && code <= last) return key + code - first;
  return ImGuiKey_None;
#endif
}

/// True if the key was pressed in this frame. If `repeat` is true, key repeats count too.
inline bool key_pressed(workspace::Key key, bool repeat = false) {
  const int k = imgui_key(static_cast<int>(key));
  return k > 0 && ImGui::IsKeyPressed(static_cast<ImGuiKey>(k), repeat);
}

/// 1 if the down arrow was pressed or repeated, -1 for the up arrow.
inline int arrow_steps() {
  return (key_pressed(workspace::Key::down, true) ? 1 : 0) - (key_pressed(workspace::Key::up, true) ? 1 : 0);
}
inline bool enter_pressed() {
  return key_pressed(workspace::Key::enter) || key_pressed(workspace::Key::pad_enter);
}

}  // namespace viete::ui
