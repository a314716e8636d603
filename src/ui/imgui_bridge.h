// The differences between the versions of Dear ImGui in distributions (1.86 to 1.92).
#pragma once

#include <imgui.h>

#include "scene/workspace/command.h"

namespace viete::ui {

/// The platform's key code (GLFW's numbers) of a named key.
constexpr int key_code(scene::Key key) {
  using scene::Key;
  switch (key) {
    case Key::none: return -1;
    case Key::escape: return 256;
    case Key::home: return 268;
    case Key::end: return 269;
    case Key::page_up: return 266;
    case Key::page_down: return 267;
    case Key::delete_key: return 261;
    case Key::enter: return 257;
    case Key::backspace: return 259;
    case Key::down: return 264;
    case Key::up: return 265;
    case Key::left: return 263;
    case Key::right: return 262;
    case Key::tab: return 258;
    case Key::insert: return 260;
    case Key::space: return 32;
    case Key::pad_point: return 330;
    case Key::pad_minus: return 333;
    case Key::pad_plus: return 334;
    case Key::pad_enter: return 335;
    default: break;
  }
  const auto among = [key](Key first, Key last, int code) {
    return key >= first && key <= last ? code + static_cast<int>(key) - static_cast<int>(first) : 0;
  };
  const int function_key = among(Key::f1, Key::f12, 290), digit = among(Key::pad0, Key::pad9, 320);
  return function_key ? function_key : digit ? digit : static_cast<int>(key);
}

/// ImGui's key for a platform key code; 0 if unused by the program. Old versions use the code itself.
inline int imgui_key(int code) {
#if IMGUI_VERSION_NUM < 18700
  return code;
#else
  if (code >= 'A' && code <= 'Z') return ImGuiKey_A + (code - 'A');
  if (code >= '0' && code <= '9') return ImGuiKey_0 + (code - '0');
  if (code >= 290 && code <= 301) return ImGuiKey_F1 + (code - 290);
  if (code >= 320 && code <= 329) return ImGuiKey_Keypad0 + (code - 320);
  switch (code) {
    case 32: return ImGuiKey_Space;
    case 44: return ImGuiKey_Comma;
    case 45: return ImGuiKey_Minus;
    case 46: return ImGuiKey_Period;
    case 47: return ImGuiKey_Slash;
    case 61: return ImGuiKey_Equal;
    case 256: return ImGuiKey_Escape;
    case 257: return ImGuiKey_Enter;
    case 258: return ImGuiKey_Tab;
    case 259: return ImGuiKey_Backspace;
    case 260: return ImGuiKey_Insert;
    case 261: return ImGuiKey_Delete;
    case 262: return ImGuiKey_RightArrow;
    case 263: return ImGuiKey_LeftArrow;
    case 264: return ImGuiKey_DownArrow;
    case 265: return ImGuiKey_UpArrow;
    case 266: return ImGuiKey_PageUp;
    case 267: return ImGuiKey_PageDown;
    case 268: return ImGuiKey_Home;
    case 269: return ImGuiKey_End;
    case 330: return ImGuiKey_KeypadDecimal;
    case 333: return ImGuiKey_KeypadSubtract;
    case 334: return ImGuiKey_KeypadAdd;
    case 335: return ImGuiKey_KeypadEnter;
    default: return ImGuiKey_None;
  }
#endif
}

/// True if the key was pressed in this frame; with `repeat` also for key repeats.
inline bool key_pressed(scene::Key key, bool repeat = false) {
  const int k = imgui_key(key_code(key));
  return k > 0 && ImGui::IsKeyPressed(static_cast<ImGuiKey>(k), repeat);
}

}  // namespace viete::ui
