// The differences between the versions of Dear ImGui in distributions (1.86 to 1.92).
#pragma once

#include <imgui.h>
#include <span>

#include "scene/workspace/command.h"

namespace viete::ui {

/// The platform's code of a key (GLFW's numbers), and ImGui's key.
struct KeyCodes {
  int platform, imgui;
};
/// In the order of scene::Key, from escape to tab.
inline constexpr KeyCodes named_keys[] = {
    {256, ImGuiKey_Escape},    {268, ImGuiKey_Home},       {269, ImGuiKey_End},     {266, ImGuiKey_PageUp},
    {267, ImGuiKey_PageDown},  {261, ImGuiKey_Delete},     {260, ImGuiKey_Insert},  {257, ImGuiKey_Enter},
    {259, ImGuiKey_Backspace}, {32, ImGuiKey_Space},       {265, ImGuiKey_UpArrow}, {264, ImGuiKey_DownArrow},
    {263, ImGuiKey_LeftArrow}, {262, ImGuiKey_RightArrow}, {258, ImGuiKey_Tab}};

/// The platform's key code of a named key.
constexpr int key_code(scene::Key key) {
  using scene::Key;
  if (key == Key::none) return -1;
  if (key < Key::escape) return static_cast<int>(key);
  const auto after = [key](Key first) { return static_cast<int>(key) - static_cast<int>(first); };
  if (key <= Key::tab) return named_keys[after(Key::escape)].platform;
  if (key <= Key::f12) return 290 + after(Key::f1);
  if (key <= Key::pad_point) return 320 + after(Key::pad0);
  return key == Key::pad_plus ? 334 : key == Key::pad_minus ? 333 : 335;
}

/// ImGui's key for a platform key code; 0 if unused by the program. Old versions use the code itself.
inline int imgui_key(int code) {
#if IMGUI_VERSION_NUM < 18700
  return code;
#else
  constexpr KeyCodes others[] = {
      {44, ImGuiKey_Comma},           {45, ImGuiKey_Minus},      {46, ImGuiKey_Period},
      {47, ImGuiKey_Slash},           {61, ImGuiKey_Equal},      {330, ImGuiKey_KeypadDecimal},
      {333, ImGuiKey_KeypadSubtract}, {334, ImGuiKey_KeypadAdd}, {335, ImGuiKey_KeypadEnter}};
  if (code >= 'A' && code <= 'Z') return ImGuiKey_A + (code - 'A');
  if (code >= '0' && code <= '9') return ImGuiKey_0 + (code - '0');
  if (code >= 290 && code <= 301) return ImGuiKey_F1 + (code - 290);
  if (code >= 320 && code <= 329) return ImGuiKey_Keypad0 + (code - 320);
  for (const std::span<const KeyCodes> table :
       {std::span<const KeyCodes>(named_keys), std::span<const KeyCodes>(others)})
    for (const KeyCodes& codes : table)
      if (codes.platform == code) return codes.imgui;
  return ImGuiKey_None;
#endif
}

/// True if the key was pressed in this frame; with `repeat` also for key repeats.
inline bool key_pressed(scene::Key key, bool repeat = false) {
  const int k = imgui_key(key_code(key));
  return k > 0 && ImGui::IsKeyPressed(static_cast<ImGuiKey>(k), repeat);
}

/// 1 if the down arrow was pressed or repeated, -1 for the up arrow.
inline int arrow_steps() {
  return (key_pressed(scene::Key::down, true) ? 1 : 0) - (key_pressed(scene::Key::up, true) ? 1 : 0);
}
inline bool enter_pressed() {
  return key_pressed(scene::Key::enter) || key_pressed(scene::Key::pad_enter);
}

}  // namespace viete::ui
