// Passes events of the window or of a script to ImGui in order.
#pragma once

#include <deque>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

namespace viete::platform {

/// Positions in logical pixels; key codes are GLFW's.
struct InputEvent {
  enum class Kind { move, button, wheel, key, text, leave };
  Kind kind = Kind::move;
  glm::vec2 position{0, 0};  ///< move
  int code = 0;              ///< button 0..2 (left, right, middle) or key
  bool down = false;
  float wheel = 0;
  std::string text{};  ///< UTF-8

  static InputEvent move(glm::vec2 to) { return {.kind = Kind::move, .position = to}; }
  static InputEvent button(int code, bool down) { return {.kind = Kind::button, .code = code, .down = down}; }
  static InputEvent scroll(float steps) { return {.kind = Kind::wheel, .wheel = steps}; }
  static InputEvent key(int code, bool down) { return {.kind = Kind::key, .code = code, .down = down}; }
  static InputEvent typed(std::string utf8) { return {.kind = Kind::text, .text = std::move(utf8)}; }
  static InputEvent left_window() { return {.kind = Kind::leave}; }
};

/// Events that ImGui cannot tell apart within one frame, such as a press and release, wait for the next
/// frame, so that a fast click is not lost.
class InputQueue {
public:
  /// ImGui's key for a key code; before ImGui 1.87 the code itself; 0: unused.
  using KeyTable = int (*)(int code);
  explicit InputQueue(KeyTable imgui_key) : imgui_key_(imgui_key) {}

  /// All characters of a frame go to the text field at once.
  void push(InputEvent event) { events_.push_back(std::move(event)); }
  bool empty() const { return events_.empty(); }

  /// Configures ImGui's input (old versions need a key map). Call once per ImGui context.
  static void configure();
  /// Feeds ImGuiIO; call before ImGui::NewFrame().
  void feed_frame();

private:
  bool is_only_written(const InputEvent& event, bool typing);

  KeyTable imgui_key_;
  bool commands_ = false;     // Ctrl or Alt is pressed
  std::vector<int> written_;  // keys pressed only for their character
  std::deque<InputEvent> events_;
};

}  // namespace viete::platform
