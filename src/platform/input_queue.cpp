#include "platform/input_queue.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cfloat>

namespace viete::platform {

namespace {

using Kind = InputEvent::Kind;

enum Modifier { shift, ctrl, alt, no_modifier };

// GLFW's key codes are consecutive: left Shift, Ctrl, Alt and Super, then the same keys on the right.
Modifier modifier_of(const InputEvent& e) {
  constexpr int left_shift = 340, right_alt = 346;
  if (e.kind != Kind::key || e.code < left_shift || e.code > right_alt) return no_modifier;
  return static_cast<Modifier>((e.code - left_shift) % 4);
}

bool is_modifier(const InputEvent& e) {
  return modifier_of(e) != no_modifier;
}

// True if the key types a character, also for keys of the number pad.
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
      if (is_modifier(e)) {
        constexpr ImGuiKey keys[] = {ImGuiMod_Shift, ImGuiMod_Ctrl, ImGuiMod_Alt};
        io.AddKeyEvent(keys[modifier_of(e)], e.down);
      }
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
      if (is_modifier(e)) *std::array{&io.KeyShift, &io.KeyCtrl, &io.KeyAlt}[modifier_of(e)] = e.down;
      if (const int key = imgui_key(e.code); key > 0 && key < 512) io.KeysDown[key] = e.down;
      break;
  }
}

#endif

}  // namespace

void InputQueue::configure() {
  ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18700
  io.ConfigInputTrickleEventQueue = false;  // this queue replaces ImGui's queue
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

// True for the events of a key that types into a text field. ImGui must get only the typed text.
bool InputQueue::is_only_written(const InputEvent& event, bool typing) {
  if (event.kind != Kind::key || is_modifier(event)) return false;
  if (!event.down) return std::erase(written_, event.code) > 0;
  if (!typing || commands_ || !writes(event.code)) return false;
  written_.push_back(event.code);
  return true;
}

// Stops at the first event that must wait for the next frame. If ImGui got all events in one frame, it would
// lose short presses, the positions of clicks, and the order of keys and modifiers.
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
    if (modifier_of(event) == ctrl || modifier_of(event) == alt) commands_ = event.down;
    stroke |= strokes;
    button_changed |= event.kind == Kind::button;
    feed(io, event, imgui_key_);
  }
}

}  // namespace viete::platform
