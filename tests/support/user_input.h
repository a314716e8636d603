// Mouse and keyboard of a test. Finds widgets by their names.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "interact/cursor_projection.h"
#include "platform/input_queue.h"
#include "support/edits.h"
#include "ui/context.h"
#include "workspace/command.h"

namespace viete::test {

/// Base of the drivers. Each event is followed by a frame, and keys, clicks and commands by enough frames for
/// the panels to settle.
class UserInput {
public:
  UserInput() = default;
  UserInput(const UserInput&) = delete;
  UserInput& operator=(const UserInput&) = delete;
  virtual ~UserInput() = default;

  virtual workspace::Workspace& workspace() = 0;
  virtual const ui::Recorder& recorder() = 0;
  virtual platform::InputQueue& input() = 0;
  virtual void frame(int count = 1) = 0;

  document::Document& document() { return workspace().document; }
  std::string last_message() {
    const auto& all = workspace().messages.all();
    return all.empty() ? "" : all.back().text;
  }
  bool has(const std::string& widget) { return recorder().find(widget).has_value(); }
  bool is_seen(const std::string& widget) {
    const auto rect = recorder().find(widget);
    return rect && rect->visible;
  }

  void send(platform::InputEvent event, int frames = 1) {
    input().push(std::move(event));
    frame(frames);
  }
  void move(glm::vec2 to) { send(platform::InputEvent::move(to)); }
  void button(int code, bool down) { send(platform::InputEvent::button(code, down)); }
  void wheel(float steps) { send(platform::InputEvent::scroll(steps)); }
  void key(int code, bool down) { send(platform::InputEvent::key(code, down)); }
  void type(const std::string& text) { send(platform::InputEvent::typed(text), settling); }
  /// Presses a key without frames after its release.
  void tap(int code, bool ctrl = false, bool shift = false, bool alt = false) {
    if (ctrl) key(left_ctrl, true);
    if (shift) key(left_shift, true);
    if (alt) key(left_alt, true);
    key(code, true);
    key(code, false);
    if (alt) key(left_alt, false);
    if (shift) key(left_shift, false);
    if (ctrl) key(left_ctrl, false);
  }
  void press_key(int code, bool ctrl = false, bool shift = false, bool alt = false) {
    tap(code, ctrl, shift, alt);
    frame(settling);
  }
  void press_key(workspace::Key k, bool ctrl = false, bool shift = false, bool alt = false) {
    press_key(static_cast<int>(k), ctrl, shift, alt);
  }

  void click(glm::vec2 at, int b = 0) {
    move(at);
    button(b, true);
    button(b, false);
    frame(settling);
  }
  void drag(glm::vec2 from, glm::vec2 to, int b = 0) {
    press_and_move(from, to, b);
    button(b, false);
    frame(settling);
  }
  void press_and_move(glm::vec2 from, glm::vec2 to, int b = 0) {
    move(from);
    button(b, true);
    for (int i = 1; i <= 8; ++i) move(glm::floor(from + (to - from) * (static_cast<float>(i) / 8)));
  }

  void run(const char* command) {
    workspace::find_command(command)->run(workspace());
    frame(settling);
  }
  /// Scrolls until the widget is visible, and clicks its center.
  void click(const std::string& widget) { click(place_of(widget)); }
  /// Opens a list, and selects an entry.
  void choose(const std::string& chooser, const std::string& item) {
    click(chooser);
    const auto rect = recorder().find(item);  // the list can cover columns and the status bar
    if (!rect || !rect->visible) return click(item);
    click(glm::vec2(0.5f * (rect->x0 + rect->x1), 0.5f * (rect->y0 + rect->y1)));
  }
  /// Unfolds sections and columns and scrolls until the widget is visible. Returns its center.
  glm::vec2 place_of(const std::string& widget) {
    if (!unfold_custom(widget)) unfold_columns(widget);
    for (int i = 0; i < 60; ++i) {
      const auto rect = recorder().find(widget);
      REQUIRE_MESSAGE(rect, "no widget named ", widget);
      const document::Viewport& v = workspace().view.camera.viewport;
      const float end = v.origin.x + v.size.x, top = v.origin.y;
      const bool in_column = rect->y1 > top && (rect->x1 <= v.origin.x || rect->x0 >= end);
      const float end_of_column = top + workspace::column_height(v);
      const bool whole = rect->visible && (!in_column || (rect->y0 >= top && rect->y1 <= end_of_column));
      if (whole) return {0.5f * (rect->x0 + rect->x1), 0.5f * (rect->y0 + rect->y1)};
      const float x = rect->x0 >= end ? 0.5f * (end + v.window.x) : 0.5f * v.origin.x;
      move({x, top + 0.5f * v.size.y});
      wheel(rect->y0 < top ? 2.0f : -2.0f);
    }
    FAIL("cannot scroll to " << widget);
    return {};
  }

  glm::vec2 on_screen(const mesh::Point& p) {
    const interact::Projector project(document().space(), workspace().view.camera);
    return glm::vec2(*project(p));
  }
  glm::vec2 vertex(std::uint32_t i) { return on_screen(document().pose().positions[i]); }
  /// Returns a visible cage vertex that is near the center of the screen and far from other vertices.
  std::uint32_t free_vertex();

  const std::vector<mesh::Point>& pose() { return document().pose().positions; }
  const std::vector<mesh::Point>& rest() { return document().cage()->surface.positions; }
  std::vector<std::uint32_t> moved() {
    std::vector<std::uint32_t> all;
    for (std::uint32_t v = 0; v < pose().size(); ++v)
      if (pose()[v] != rest()[v]) all.push_back(v);
    return all;
  }
  std::size_t edits() { return edit_count(document().history()); }
  void select_whole_cage() {
    press_key('A');
    press_key('E');
    CHECK(document().selection().size() == pose().size());
  }
  void enter(const char* field, const char* number) {
    type_in(field, number);
    press_key(workspace::Key::enter);
  }
  void type_in(const char* field, const char* number) {
    click(field);
    press_key('A', true);
    type(number);
  }

  static constexpr int left_ctrl = 341, left_shift = 340, left_alt = 342;
  static constexpr int settling = 4;  ///< the number of frames after a key, a click or a command

private:
  /// Unfolds columns until the widget exists.
  void unfold_columns(const std::string& widget) {
    for (const char* column : {"toggle_methods", "toggle_tools"}) {
      const bool methods = std::string_view(column) == "toggle_methods";
      const auto shown =
          workspace::shown_columns(workspace().preferences.layout, workspace().view.camera.viewport.window.x);
      if ((methods ? shown.methods : shown.tools) > 0) continue;
      run(column);
      if (unfold_custom(widget)) return;
    }
  }
  /// Unfolds the custom settings of the deformer if they contain `widget`. Returns true if `widget` exists.
  bool unfold_custom(const std::string& widget) {
    static const std::set<std::string> parts = {"weights", "blend", "toggle_arap", "iterations",
                                                "attach",  "hold",  "formula"};
    if (parts.contains(widget) && !has(widget) && has("section/Custom deformer")) {
      workspace().preferences.layout.sections["Custom deformer"] = true;
      frame(3);
    }
    return has(widget);
  }
};

inline std::uint32_t UserInput::free_vertex() {
  const auto& w = workspace();
  const interact::Projector project(w.document.space(), w.view.camera);
  const glm::vec2 middle = w.view.camera.viewport.middle();
  std::uint32_t best = 0;
  float best_score = -1e9f;
  const auto& points = w.document.pose().positions;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const glm::vec3 projected = *project(points[i]);
    const glm::vec2 at(projected);
    float room = 1e9f;
    for (std::uint32_t j = 0; j < points.size(); ++j)
      if (j != i) room = std::min(room, glm::distance(at, glm::vec2(*project(points[j]))));
    const float score = std::min(room, 30.0f) - 0.02f * glm::distance(at, middle) - 40 * projected.z;
    if (score > best_score) {
      best = i;
      best_score = score;
    }
  }
  return best;
}

}  // namespace viete::test
