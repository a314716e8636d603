#include "app/script_recorder.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>
#include <utility>

#include "base/atomic_file.h"
#include "base/clock.h"
#include "base/error.h"
#include "scene/workspace/command.h"
#include "scene/workspace/saving.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

constexpr double shortest_pause = 0.5;

double snapped(double value, double step) {
  return step * std::round(value / step);
}

fs::path dated(const fs::path& folder) {
  char name[64];
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::strftime(name, sizeof name, "viete-%Y%m%d-%H%M%S", &local);
  return folder / name;
}

bool contains(const ui::WidgetRect& rect, glm::vec2 at) {
  return rect.visible && at.x >= rect.x0 && at.x <= rect.x1 && at.y >= rect.y0 && at.y <= rect.y1;
}

float area(const ui::WidgetRect& rect) {
  return (rect.x1 - rect.x0) * (rect.y1 - rect.y0);
}

// The smallest one: a button rather than its list; what ends the recording is not there in a replay. Empty:
// none.
std::string widget_at(glm::vec2 at, const ui::Recorder& widgets) {
  std::string found;
  float smallest = 0;
  for (const auto& [name, rect] : widgets.all()) {
    if (name == "recording" || !contains(rect, at) || (!found.empty() && area(rect) >= smallest)) continue;
    found = name, smallest = area(rect);
  }
  return found;
}

// A session does not have these.
void settle(scene::Workspace& w) {
  w.camera.set_pose(w.camera.pose());
  w.chosen_pose.reset();
  w.time_view = {};
  w.interaction.armed.reset();
  w.interaction.grab.reset();
}

}  // namespace

ScriptRecorder::ScriptRecorder(fs::path file, std::ofstream out)
    : file_(std::move(file)), out_(std::move(out)), last_(base::wall_seconds()) {}

void ScriptRecorder::begin(scene::Workspace& w, const fs::path& folder) {
  settle(w);
  Script script;
  script.file = base::unused_name(dated(folder).concat(Script::extension));
  script.window = glm::ivec2(w.viewport.window + 0.5f);
  script.view = w.viewport.seen().y;
  script.arranged = scene::arrangement_of(w.remembered);
  script.brush_radius = w.brush.radius, script.brush_share = w.brush.share;
  if (w.document.model.surface) {
    const fs::path session =
        base::unused_name(fs::path(script.file).replace_extension(scene::session_extension));
    base::replace_file(session, scene::session_text(scene::session_of(w), session));
    script.open = {session};
  }
  std::string head = head_of(script);
  for (const scene::Command& command : scene::commands())
    if (command.group == "Tool" && command.name.starts_with("tool_") && command.on(w))
      head += text_of(Step{.kind = Step::Kind::command, .text = command.name}, folder);
  base::replace_file(script.file, head);
  std::ofstream out(script.file, std::ios::app | std::ios::binary);
  if (!out) throw base::Error(script.file.string(), "it cannot be written");
  *this = ScriptRecorder(std::move(script.file), std::move(out));
}

fs::path ScriptRecorder::end() {
  out_->flush();
  const bool written = out_->good();
  out_.reset();
  if (!written) throw base::Error(file_.string(), "not all of it could be written", "make room on this disk");
  return std::exchange(file_, {});
}

void ScriptRecorder::write(const Step& step) {
  line_ += text_of(step, file_.parent_path());
}

// What is held stays where it was taken.
Place ScriptRecorder::place_of(glm::vec2 at, const scene::Workspace& w, const ui::Recorder& widgets) {
  const std::string name = held_in_ ? *held_in_ : widget_at(at, widgets);
  const glm::dvec2 place(at);
  if (const auto rect = widgets.find(name))
    return {Place::Of::widget, name, 0,
            place - 0.5 * glm::dvec2(double(rect->x0) + rect->x1, double(rect->y0) + rect->y1)};
  const glm::vec2 low = w.viewport.origin, high = low + w.viewport.size;
  const bool in_view = glm::all(glm::greaterThanEqual(at, low)) && glm::all(glm::lessThan(at, high));
  if (!held_in_ && !in_view) return {Place::Of::window, {}, 0, place};
  return {Place::Of::view, {}, 0, place - glm::dvec2(w.viewport.middle())};
}

void ScriptRecorder::take(platform::InputEvent& event, const scene::Workspace& w,
                          const ui::Recorder& widgets) {
  using Event = platform::InputEvent::Kind;
  Step step;
  step.code = event.code;
  switch (event.kind) {
    case Event::move:
      event.position =
          glm::vec2(snapped(event.position.x, script_pixel), snapped(event.position.y, script_pixel));
      step.kind = Step::Kind::move;
      step.place = place_of(event.position, w, widgets);
      cursor_ = event.position;
      break;
    case Event::button:
      step.kind = event.down ? Step::Kind::press : Step::Kind::release;
      held_ = std::max(0, held_ + (event.down ? 1 : -1));
      if (held_ == 0) held_in_.reset();
      if (event.down && held_ == 1) held_in_ = widget_at(cursor_, widgets);
      break;
    case Event::wheel:
      event.wheel = static_cast<float>(snapped(event.wheel, script_pixel));
      step.kind = Step::Kind::wheel;
      step.number = event.wheel;
      break;
    case Event::key: step.kind = event.down ? Step::Kind::key_down : Step::Kind::key_up; break;
    case Event::text:
      step.kind = Step::Kind::type;
      step.text = event.text;
      break;
    case Event::leave: step.kind = Step::Kind::leave; break;
  }
  write(step);
}

void ScriptRecorder::take_files(const std::vector<fs::path>& files) {
  write({.kind = Step::Kind::drop, .files = files});
}

void ScriptRecorder::take_size(glm::ivec2 size) {
  write({.kind = Step::Kind::size, .size = size});
}

float ScriptRecorder::begin_frame(float seconds) {
  frame_ = std::max(script_second, snapped(seconds, script_second));
  return static_cast<float>(frame_);
}

// Where work has ended in this frame, a replay waits for it before.
bool ScriptRecorder::end_frame(bool working) {
  if (frame_ == 0) return true;  // it began before the recording
  const double now = base::wall_seconds();
  const double idle = snapped(now - std::exchange(last_, now) - frame_, 1.0 / 16);
  if (idle >= shortest_pause) *out_ << text_of(Step{.kind = Step::Kind::pause, .number = idle}, {});
  if (std::exchange(working_, working) && !working) write({.kind = Step::Kind::wait});
  write({.kind = Step::Kind::frame, .code = 1, .number = frame_});
  *out_ << std::exchange(line_, {}) << std::flush;
  seconds_ += frame_ + std::max(0.0, idle >= shortest_pause ? idle : 0.0);
  return out_->good();
}

}  // namespace viete::app
