// A simulated mouse over the view of a workspace.
#pragma once

#include <utility>

#include "interact/cursor_projection.h"
#include "workspace/pointer.h"

namespace viete::test {

struct Mouse {
  explicit Mouse(workspace::Workspace workspace) : w(std::move(workspace)) {}

  workspace::Workspace w;
  workspace::Pointer pointer;
  workspace::PointerInput input;

  glm::vec3 seen(std::uint32_t v) const {
    return *interact::Projector(w.document.space(), w.view.camera)(w.document.pose().positions[v]);
  }
  glm::vec2 vertex(std::uint32_t v) const { return glm::vec2(seen(v)); }
  void step() {
    pointer.frame(w, input);
    input.escape = false;
    input.wheel = 0;
  }
  void move(glm::vec2 to) {
    input.position = to;
    step();
  }
  void press(int b = workspace::left_button) {
    input.down[b] = true;
    step();
  }
  void release(int b = workspace::left_button) {
    input.down[b] = false;
    step();
  }
  void turn_wheel(float steps) {
    input.wheel = steps;
    step();
  }
  void press_escape() {
    input.escape = true;
    step();
  }
  void click(glm::vec2 at) {
    move(at);
    press();
    release();
  }
  void begin(glm::vec2 from, glm::vec2 to, int b = workspace::left_button) {
    move(from);
    press(b);
    for (int i = 1; i <= 8; ++i) move(from + (to - from) * (static_cast<float>(i) / 8));
  }
  void drag(glm::vec2 from, glm::vec2 to, int b = workspace::left_button) {
    begin(from, to, b);
    release(b);
  }
};

}  // namespace viete::test
