#include "platform/input_queue.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <utility>
#include <vector>

namespace viete::platform {

namespace {

using Kind = InputEvent::Kind;

// GLFW's codes of the modifier keys, left and right.
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
#if IMGUI_VERSION_NUM < 18700
  ImGuiIO& io = ImGui::GetIO();
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

// One frame takes many events, but never two changes of one key or button, no movement after a button, no
// change of a modifier after a key or button, and, unless text is being typed, no second key: ImGui looks
// once a frame, and would see neither the short press, nor where the button went down, nor that Ctrl was held
// when the key was, nor which key came first.
void InputQueue::feed_frame() {
  ImGuiIO& io = ImGui::GetIO();
  std::vector<std::pair<Kind, int>> changed;
  bool button_changed = false, stroke = false;
  while (!events_.empty()) {
    const InputEvent& event = events_.front();
    const bool switches = event.kind == Kind::button || event.kind == Kind::key;
    const std::pair what{event.kind, event.code};
    if (switches && std::find(changed.begin(), changed.end(), what) != changed.end()) return;
    if (button_changed && event.kind != Kind::key) return;
    const bool strokes = switches && !is_modifier(event);
    if (stroke && is_modifier(event)) return;
    if (stroke && strokes && event.down && !io.WantTextInput) return;
    if (switches) changed.push_back(what);
    stroke |= strokes;
    button_changed |= event.kind == Kind::button;
    feed(io, event, imgui_key_);
    events_.pop_front();
  }
}

}  // namespace viete::platform
