// Passes the events of a window or a script to ImGui, in order.
#pragma once

#include <deque>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

namespace viete::platform {

struct InputEvent {
  enum class Kind { move, button, wheel, key, text, leave };
  Kind kind = Kind::move;
  glm::vec2 position{0, 0};  ///< for moves; in logical pixels
  int code = 0;              ///< for buttons: 0 left, 1 right, 2 middle; for keys: the key code of GLFW
  bool down = false;
  float wheel = 0;
  std::string text{};  ///< the typed text, in UTF-8

  static InputEvent move(glm::vec2 to) { return {.kind = Kind::move, .position = to}; }
  static InputEvent button(int code, bool down) { return {.kind = Kind::button, .code = code, .down = down}; }
  static InputEvent scroll(float steps) { return {.kind = Kind::wheel, .wheel = steps}; }
  static InputEvent key(int code, bool down) { return {.kind = Kind::key, .code = code, .down = down}; }
  static InputEvent typed(std::string utf8) { return {.kind = Kind::text, .text = std::move(utf8)}; }
  static InputEvent left_window() { return {.kind = Kind::leave}; }
};

/// Delays events for ImGui. If two events change the same button in one frame, as in a fast click, ImGui may
/// lose an event. The second event therefore waits for the next frame.
class InputQueue {
public:
  /// Returns ImGui's key for a key code of GLFW, or 0 for an unused key. Before ImGui 1.87, returns the code.
  using KeyTable = int (*)(int code);
  explicit InputQueue(KeyTable imgui_key) : imgui_key_(imgui_key) {}

  void push(InputEvent event) { events_.push_back(std::move(event)); }
  bool empty() const { return events_.empty(); }

  /// Configures the input of ImGui. Call this once per ImGui context.
  static void configure();
  /// Passes the events of a frame to ImGuiIO. Call this before ImGui::NewFrame().
  void feed_frame();

private:
  bool is_only_written(const InputEvent& event, bool typing);

  KeyTable imgui_key_;
  bool commands_ = false;     // true while Ctrl or Alt is pressed
  std::vector<int> written_;  // pressed keys that ImGui gets only as typed text
  std::deque<InputEvent> events_;
};

}  // namespace viete::platform
