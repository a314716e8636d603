#include "platform/input_queue.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <utility>
#include <vector>

namespace viete::platform {

namespace {

using Kind = InputEvent::Kind;

// GLFW codes of the left and right modifier keys.
bool is_shift(int code) {
  return code == 340 || code == 344;
}
bool is_ctrl(int code) {
  return code == 341 || code == 345;
}
bool is_alt(int code) {
  return code == 342 || code == 346;
}

bool is_modifier(const InputEvent& e) {
  return e.kind == Kind::key && (is_shift(e.code) || is_ctrl(e.code) || is_alt(e.code));
}

// With these modifiers a key is a command, even in a text field.
bool is_command_key(const InputEvent& e) {
  return e.kind == Kind::key && (is_ctrl(e.code) || is_alt(e.code));
}

// GLFW codes of character keys: alphanumeric block and number pad.
bool writes(int code) {
  return (code >= 32 && code < 256) || (code >= 320 && code <= 334);
}

#if IMGUI_VERSION_NUM >= 18700

void feed(ImGuiIO& io, const InputEvent& e, InputQueue::KeyTable imgui_key) {
  switch (e.kind) {
    case Kind::move: io.AddMousePosEvent(e.position.x, e.position.y); break;
    case Kind::leave: io.AddMousePosEvent(-FLT_MAX, -FLT_MAX); break;
    case Kind::button: io.AddMouseButtonEvent(e.code, e.down); break;
    case Kind::wheel: io.AddMouseWheelEvent(0, e.wheel); break;
    case Kind::text: io.AddInputCharactersUTF8(e.text.c_str()); break;
    case Kind::key:
      if (is_shift(e.code)) io.AddKeyEvent(ImGuiMod_Shift, e.down);
      if (is_ctrl(e.code)) io.AddKeyEvent(ImGuiMod_Ctrl, e.down);
      if (is_alt(e.code)) io.AddKeyEvent(ImGuiMod_Alt, e.down);
      if (const int key = imgui_key(e.code); key > 0) io.AddKeyEvent(static_cast<ImGuiKey>(key), e.down);
      break;
  }
}

#else

void feed(ImGuiIO& io, const InputEvent& e, InputQueue::KeyTable imgui_key) {
  switch (e.kind) {
    case Kind::move: io.MousePos = {e.position.x, e.position.y}; break;
    case Kind::leave: io.MousePos = {-FLT_MAX, -FLT_MAX}; break;
    case Kind::button: io.MouseDown[e.code] = e.down; break;
    case Kind::wheel: io.MouseWheel += e.wheel; break;
    case Kind::text: io.AddInputCharactersUTF8(e.text.c_str()); break;
    case Kind::key:
      if (is_shift(e.code)) io.KeyShift = e.down;
      if (is_ctrl(e.code)) io.KeyCtrl = e.down;
      if (is_alt(e.code)) io.KeyAlt = e.down;
      if (const int key = imgui_key(e.code); key > 0 && key < 512) io.KeysDown[key] = e.down;
      break;
  }
}

#endif

}  // namespace

void InputQueue::configure() {
  ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18700
  io.ConfigInputTrickleEventQueue = false;  // done by this queue
#else
  const struct {
    ImGuiKey key;
    int code;
  } map[] = {{ImGuiKey_Tab, 258},        {ImGuiKey_LeftArrow, 263},
             {ImGuiKey_RightArrow, 262}, {ImGuiKey_UpArrow, 265},
             {ImGuiKey_DownArrow, 264},  {ImGuiKey_PageUp, 266},
             {ImGuiKey_PageDown, 267},   {ImGuiKey_Home, 268},
             {ImGuiKey_End, 269},        {ImGuiKey_Insert, 260},
             {ImGuiKey_Delete, 261},     {ImGuiKey_Backspace, 259},
             {ImGuiKey_Space, 32},       {ImGuiKey_Enter, 257},
             {ImGuiKey_Escape, 256},     {ImGuiKey_KeyPadEnter, 335},
             {ImGuiKey_A, 'A'},          {ImGuiKey_C, 'C'},
             {ImGuiKey_V, 'V'},          {ImGuiKey_X, 'X'},
             {ImGuiKey_Y, 'Y'},          {ImGuiKey_Z, 'Z'}};
  for (const auto& entry : map) io.KeyMap[entry.key] = entry.code;
#endif
}

// Text fields use the character, not the key. A key release is only passed on if its press was.
bool InputQueue::is_only_written(const InputEvent& event, bool typing) {
  if (event.kind != Kind::key || is_modifier(event)) return false;
  if (!event.down) return std::erase(written_, event.code) > 0;
  if (!typing || commands_ || !writes(event.code)) return false;
  written_.push_back(event.code);
  return true;
}

// A frame accepts many events, but never two changes of one key or button, a move after a button, a modifier
// change after a key or button, a second key, or, in a text field, text after a key. ImGui samples its input
// once per frame and would lose short presses, press positions, modifiers and the order of keys. Text alone
// goes into a field at once, including capitals.
void InputQueue::feed_frame() {
  ImGuiIO& io = ImGui::GetIO();
  const bool typing = io.WantTextInput;
  std::vector<std::pair<Kind, int>> changed;
  bool button_changed = false, stroke = false;
  for (; !events_.empty(); events_.pop_front()) {
    const InputEvent& event = events_.front();
    if (is_only_written(event, typing)) continue;
    const bool switches =
        event.kind == Kind::button || (event.kind == Kind::key && !(typing && is_modifier(event)));
    const std::pair what{event.kind, event.code};
    if (switches && std::find(changed.begin(), changed.end(), what) != changed.end()) return;
    if (button_changed && event.kind != Kind::key) return;
    const bool strokes = switches && !is_modifier(event);
    if (stroke && (is_modifier(event) || (strokes && event.down))) return;
    if (stroke && typing && event.kind == Kind::text) return;
    if (switches) changed.push_back(what);
    if (is_command_key(event)) commands_ = event.down;
    stroke |= strokes;
    button_changed |= event.kind == Kind::button;
    feed(io, event, imgui_key_);
  }
}

}  // namespace viete::platform
