// Runs the program offscreen with simulated mouse and key events.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "app/offscreen_viewer.h"
#include "base/worker_pool.h"
#include "deform/exact.h"
#include "files/export.h"
#include "interact/cursor_projection.h"
#include "interact/picking.h"
#include "program/dragon.h"
#include "program/no_pixels.h"
#include "support/distance.h"
#include "ui/imgui_bridge.h"
#include "workspace/command.h"

namespace viete::test {

/// An argument of Driver for tests that need pixels.
struct WithPixels {
  platform::OffscreenContext::Kind kind = platform::OffscreenContext::Kind::any;
};
inline constexpr WithPixels with_pixels;

/// The program in a test. Draws only if a test needs pixels or VIETE_PICTURES is set.
class Driver {
public:
  explicit Driver(const app::ViewerOptions& options = default_options(),
                  std::optional<WithPixels> pixels = pictures_wanted())
      : offscreen_(options,
                   pixels ? platform::OffscreenContext::create(pixels->kind) : std::make_unique<NoPixels>()) {
    document().put_deformer({});  // the deformer "As published"
    for (const char* title : {"Transform", "Select", "Display", "Analysis"})
      workspace().preferences.layout.sections[title] = true;
  }

  explicit Driver(WithPixels pixels) : Driver(default_options(), pixels) {}
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;
  /// Checks at the end of every test that the program comes to rest.
  ~Driver() {
    if (std::uncaught_exceptions() == 0) check_rest();
  }

  /// If there is no playback and no background work, runs frames until no activity is due. Then another frame
  /// must not draw anything new.
  void check_rest() {
    const auto busy = [&] {
      return viewer().working() || viewer().checking() || workspace().playback.playing;
    };
    for (int i = 0; i < 100 && !busy() && viewer().wants_frame(); ++i) frame();
    if (busy()) return;
    CHECK_MESSAGE(!viewer().wants_frame(), "the activity '", viewer().due_activity(), "' does not end");
    frame();
    CHECK_FALSE(viewer().has_drawn());
    CHECK_MESSAGE(!viewer().wants_frame(), "the activity '", viewer().due_activity(), "' begins by itself");
  }

  static std::optional<WithPixels> pictures_wanted() {
    return std::getenv("VIETE_PICTURES") ? std::optional(with_pixels) : std::nullopt;
  }
  static app::ViewerOptions default_options() { return default_options({1280, 800}); }
  static app::ViewerOptions default_options(glm::ivec2 size) {
    app::ViewerOptions options;
    options.size = size;
    options.builtin_font = true;
    options.probe = false;
    return options;
  }

  app::Viewer& viewer() { return offscreen_.viewer(); }
  workspace::Workspace& workspace() { return viewer().workspace(); }
  document::Document& document() { return workspace().document; }
  std::string last_message() {
    const auto& all = workspace().messages.all();
    return all.empty() ? "" : all.back().text;
  }
  void settle() { offscreen_.settle(); }
  render::Image picture() { return viewer().picture(); }

  using What = files::OpenRequest::What;
  /// Opens files, and runs frames until they are open. Returns false on a refusal or a question.
  [[nodiscard]] bool open(std::vector<std::filesystem::path> files, What what = What::model);
  /// Opens the dragon and its cage, at rest or in a pose. Waits until the picture no longer changes.
  void open_dragon(const std::string& pose = "", const std::filesystem::path& model = dragon);

  void frame(int count = 1) {
    for (int i = 0; i < count; ++i) viewer().frame(1.0f / 60);
  }
  /// Runs frames until the condition is true. If this takes five minutes, returns false.
  template <class Condition>
  [[nodiscard]] bool until(Condition has_come) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(5);
    while (!has_come()) {
      if (std::chrono::steady_clock::now() > end) return false;
      frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }
  /// Runs frames until the generated cage follows the current settings. After a preview, also waits for the
  /// cage of full quality.
  void finish_making() {
    do {
      frame();
      REQUIRE(until([&] { return !workspace().jobs.making_cage.running; }));
      std::this_thread::sleep_for(std::chrono::milliseconds(400));
      frame();
    } while (workspace().jobs.making_cage.running);
  }
  void send(platform::InputEvent event, int frames = 1) {
    viewer().input().push(std::move(event));
    frame(frames);
  }
  void move(glm::vec2 to) { send(platform::InputEvent::move(to)); }
  void button(int code, bool down) { send(platform::InputEvent::button(code, down)); }
  void wheel(float steps) { send(platform::InputEvent::scroll(steps)); }
  void key(int code, bool down) { send(platform::InputEvent::key(code, down)); }
  void type(const std::string& text) { send(platform::InputEvent::typed(text), 2); }
  void press_key(int code, bool ctrl = false, bool shift = false, bool alt = false) {
    if (ctrl) key(left_ctrl, true);
    if (shift) key(left_shift, true);
    if (alt) key(left_alt, true);
    key(code, true);
    key(code, false);
    if (alt) key(left_alt, false);
    if (shift) key(left_shift, false);
    if (ctrl) key(left_ctrl, false);
  }
  void press_key(workspace::Key k, bool ctrl = false, bool shift = false, bool alt = false) {
    press_key(static_cast<int>(k), ctrl, shift, alt);
  }

  void click(glm::vec2 at, int b = 0) {
    move(at);
    button(b, true);
    button(b, false);
    frame();
  }
  void drag(glm::vec2 from, glm::vec2 to, int b = 0) {
    press_and_move(from, to, b);
    button(b, false);
    frame();
  }
  void press_and_move(glm::vec2 from, glm::vec2 to, int b = 0) {
    move(from);
    button(b, true);
    for (int i = 1; i <= 8; ++i) move(glm::floor(from + (to - from) * (static_cast<float>(i) / 8)));
  }

  /// Unfolds columns until the widget exists.
  void unfold_columns(const std::string& widget) {
    for (const char* column : {"toggle_methods", "toggle_tools"}) {
      const bool methods = std::string_view(column) == "toggle_methods";
      const auto shown =
          workspace::shown_columns(workspace().preferences.layout, workspace().view.viewport.window.x);
      if ((methods ? shown.methods : shown.tools) > 0) continue;
      workspace::find_command(column)->run(workspace());
      frame(3);
      if (unfold_custom(widget)) return;
    }
  }
  /// Unfolds the custom settings of the deformer if they contain `widget`. Returns true if `widget` exists.
  bool unfold_custom(const std::string& widget) {
    static const std::set<std::string> parts = {"weights", "blend", "toggle_arap", "iterations",
                                                "attach",  "hold",  "formula"};
    const auto& recorder = viewer().recorder();
    if (parts.contains(widget) && !recorder.find(widget) && recorder.find("section/Custom deformer")) {
      workspace().preferences.layout.sections["Custom deformer"] = true;
      frame(3);
    }
    return recorder.find(widget).has_value();
  }
  void run(const char* command) {
    workspace::find_command(command)->run(workspace());
    frame(2);
  }
  /// Scrolls until the widget is visible, and clicks its center.
  void click(const std::string& widget) { click(place_of(widget)); }
  /// Opens a list, and selects an entry.
  void choose(const std::string& chooser, const std::string& item) {
    click(chooser);
    frame(2);
    const auto rect = viewer().recorder().find(item);  // the list can cover columns and the status bar
    if (!rect || !rect->visible) return click(item);
    click(glm::vec2(0.5f * (rect->x0 + rect->x1), 0.5f * (rect->y0 + rect->y1)));
  }
  glm::vec2 place_of(const std::string& widget) {
    if (!unfold_custom(widget)) unfold_columns(widget);
    for (int i = 0; i < 60; ++i) {
      const auto rect = viewer().recorder().find(widget);
      REQUIRE_MESSAGE(rect, "no widget named ", widget);
      const document::Viewport& v = workspace().view.viewport;
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

  /// Returns the deformed model in double precision, as an export writes it.
  std::vector<mesh::Point> exact_positions() {
    base::WorkerPool pool;
    const files::Export e = files::export_of(document(), {});
    return deform::deform_exactly(*e.model, e.cage, e.deformer, e.pose, e.method, pool, nullptr, e.mask,
                                  e.probes, e.shape)
        .positions;
  }

  /// Returns the largest error of the drawn vertices, in diagonals of the model.
  double drawn_error() {
    return largest_distance(exact_positions(), viewer().deformer()->positions()) /
           document().model().bounds.diagonal();
  }

  glm::vec2 on_screen(const mesh::Point& p) {
    const interact::Projector project(document().space(), workspace().view.camera, workspace().view.viewport);
    return glm::vec2(*project(p));
  }
  glm::vec2 vertex(std::uint32_t i) { return on_screen(document().pose().positions[i]); }
  /// Returns a visible cage vertex that is near the center of the screen and far from other vertices.
  std::uint32_t free_vertex();

  static constexpr int left_ctrl = 341, left_shift = 340, left_alt = 342;

private:
  app::OffscreenViewer offscreen_;
};

inline bool Driver::open(std::vector<std::filesystem::path> files, What what) {
  const document::Revision before = document().revisions().pose;
  workspace().jobs.wishes.open({what, std::move(files)});
  frame();
  REQUIRE(until([&] { return !viewer().loading(); }));
  return document().revisions().pose != before;
}

inline void Driver::open_dragon(const std::string& pose, const std::filesystem::path& model) {
  std::vector<std::filesystem::path> files = {model, dragon_cage};
  if (!pose.empty()) files.push_back(dragon_cage.parent_path() / (pose + ".obj"));
  REQUIRE(open(files));
  settle();
}

inline std::uint32_t Driver::free_vertex() {
  const auto& w = workspace();
  const interact::Projector project(w.document.space(), w.view.camera, w.view.viewport);
  const glm::vec2 middle = w.view.viewport.origin + 0.5f * w.view.viewport.size;
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
