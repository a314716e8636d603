#include "app/script_player.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "base/error.h"
#include "scene/hand/projector.h"
#include "scene/workspace/command.h"
#include "scene/workspace/taking.h"

namespace viete::app {

namespace {

using Do = Step::Kind;
using Turn = ScriptPlayer::Turn;
using After = Turn::What;

constexpr float usual_frame = 1.0f / 64;  // of what has no frames of its own
constexpr int looks_in_place = 8;         // frames until what has just opened has its size
constexpr int most_looks = 120;           // frames until a widget is there, or in sight

// The middle of the column that it is in, where the wheel scrolls.
glm::vec2 column_of(const ui::WidgetRect& rect, const scene::Viewport& v) {
  const float end = v.origin.x + v.size.x;
  return {rect.x0 >= end ? 0.5f * (end + v.window.x) : 0.5f * v.origin.x, v.origin.y + 0.5f * v.size.y};
}

bool in_sight(const ui::WidgetRect& rect, const scene::Viewport& v) {
  const bool in_view = rect.x1 > v.origin.x && rect.x0 < v.origin.x + v.size.x;
  const float middle = 0.5f * (rect.y0 + rect.y1);
  return rect.visible &&
         (in_view || (middle > v.origin.y && middle < v.window.y - scene::PanelLayout::status_height) ||
          middle < v.origin.y);
}

}  // namespace

void ScriptPlayer::fail(const Step& step, const std::string& problem, const std::string& advice) const {
  throw base::Error(script_.file.string() + ':' + std::to_string(step.line), problem, advice);
}

void ScriptPlayer::open() {
  scene::Workspace& w = viewer_.workspace();
  if (!script_.arranged.empty()) {
    scene::arrange(w.remembered, script_.arranged, script_.file.string());
    w.view.dark = w.remembered.dark;
  }
  if (script_.brush_radius > 0) {
    w.brush.radius = static_cast<float>(script_.brush_radius);
    w.brush.share = static_cast<float>(script_.brush_share);
  }
  if (!script_.open.empty())
    w.requests.open = scene::OpenRequest{scene::OpenRequest::What::model, script_.open};
}

void ScriptPlayer::begin() {
  if (!script_.poses.empty()) scene::add_motion(viewer_.workspace(), script_.poses);
  viewer_.workspace().scripting.playing = true;
}

void ScriptPlayer::release() {
  for (platform::InputEvent& event : held_) push(std::move(event));
  held_.clear();
}

void ScriptPlayer::go_to(std::size_t number) {
  release();
  std::size_t passed = 0;
  for (at_ = 0; at_ < script_.steps.size(); ++at_)
    if (script_.steps[at_].kind == Do::chapter && ++passed == number) break;
  repeated_ = looked_ = 0, glided_ = 0;
}

std::size_t ScriptPlayer::chapter() const {
  const auto end = script_.steps.begin() + static_cast<std::ptrdiff_t>(at_);
  return static_cast<std::size_t>(
      std::count_if(script_.steps.begin(), end, [](const Step& step) { return step.kind == Do::chapter; }));
}

void ScriptPlayer::move(glm::vec2 to) {
  cursor_ = to;
  push(platform::InputEvent::move(to));
}

glm::vec2 ScriptPlayer::resolve(const Step& step) const {
  const scene::Workspace& w = viewer_.workspace();
  const Place& place = step.place;
  const double scale = script_.view > 0 ? w.viewport.seen().y / script_.view : 1;
  switch (place.of) {
    case Place::Of::window: return glm::vec2(place.by);
    case Place::Of::cursor: return glm::vec2(glm::dvec2(cursor_) + scale * place.by);
    case Place::Of::view: return glm::vec2(glm::dvec2(w.viewport.middle()) + scale * place.by);
    case Place::Of::widget: {
      const ui::WidgetRect rect = *viewer_.recorder().find(place.widget);
      return glm::vec2(0.5 * glm::dvec2(double(rect.x0) + rect.x1, double(rect.y0) + rect.y1) + place.by);
    }
    case Place::Of::vertex: break;
  }
  if (!w.document.has_cage() || place.vertex >= w.document.pose.positions.size())
    fail(step, "there is no cage with a vertex " + std::to_string(place.vertex), "open another model");
  const scene::Projector project(w.document.space, w.camera, w.viewport);
  const auto seen = project(w.document.pose.positions[place.vertex]);
  if (!seen)
    fail(step, "vertex " + std::to_string(place.vertex) + " is behind the camera", "frame all first");
  return glm::vec2(glm::dvec2(glm::vec2(*seen)) + scale * place.by);
}

// A widget may be in a section that opens, or below in its column. Nothing: it is there.
std::optional<Turn> ScriptPlayer::reach(const Step& step) {
  if (step.place.of != Place::Of::widget || !held_.empty()) return std::nullopt;
  const auto rect = viewer_.recorder().find(step.place.widget);
  const scene::Viewport& v = viewer_.workspace().viewport;
  if (rect && in_sight(*rect, v)) return std::nullopt;
  if (++looked_ > most_looks)
    fail(step, "\"" + step.place.widget + "\" is not to be seen here",
         "record it again, or open its section first");
  if (rect && looked_ > looks_in_place) {
    move(column_of(*rect, v));
    push(platform::InputEvent::scroll(rect->y0 < v.origin.y ? 1.0f : -1.0f));
  }
  return Turn{After::frame, usual_frame};
}

Turn ScriptPlayer::glide(const Step& step, float seconds) {
  if (glided_ == 0) from_ = cursor_, to_ = resolve(step);
  glided_ += seconds;
  const auto t = static_cast<float>(step.number > 0 ? std::min(glided_ / step.number, 1.0) : 1.0);
  move(glm::mix(from_, to_, t * t * (3 - 2 * t)));
  if (t == 1) ++at_, glided_ = 0;
  return {After::frame, seconds};
}

Turn ScriptPlayer::next(float seconds) {
  while (at_ < script_.steps.size()) {
    const Step& step = script_.steps[at_];
    const bool goes_somewhere = step.kind == Do::move || step.kind == Do::glide;
    if (goes_somewhere && glided_ == 0) {
      if (const auto turn = reach(step)) return *turn;
      looked_ = 0;
    }
    if (step.kind == Do::glide) return glide(step, seconds);
    if (step.kind == Do::frame && ++repeated_ < step.code)
      return {After::frame, static_cast<float>(step.number)};
    repeated_ = 0;
    ++at_;
    const auto said = static_cast<float>(step.number);
    switch (step.kind) {
      case Do::frame: return {After::frame, said};
      case Do::wait: return {After::wait};
      case Do::pause: return {After::pause, said};
      case Do::chapter: return {After::chapter};
      default: take(step);
    }
  }
  release();
  return {After::end};
}

void ScriptPlayer::take(const Step& step) {
  using platform::InputEvent;
  scene::Workspace& w = viewer_.workspace();
  switch (step.kind) {
    case Do::move: return move(resolve(step));
    case Do::press:
      held_.push_back(InputEvent::button(step.code, false));
      return push(InputEvent::button(step.code, true));
    case Do::key_down:
      held_.push_back(InputEvent::key(step.code, false));
      return push(InputEvent::key(step.code, true));
    case Do::release:
    case Do::key_up: {
      InputEvent up =
          step.kind == Do::key_up ? InputEvent::key(step.code, false) : InputEvent::button(step.code, false);
      std::erase_if(held_,
                    [&](const InputEvent& held) { return held.kind == up.kind && held.code == up.code; });
      return push(std::move(up));
    }
    case Do::type: return push(InputEvent::typed(step.text));
    case Do::wheel: return push(InputEvent::scroll(static_cast<float>(step.number)));
    case Do::leave: return push(InputEvent::left_window());
    case Do::drop: return viewer_.drop(step.files);
    case Do::size: return viewer_.resize(step.size);
    default: break;
  }
  const scene::Command& command = *scene::find_command(step.text);
  if (step.kind == Do::try_command && !command.enabled(w)) return;
  if (!command.enabled(w))
    fail(step, "\"" + command.label + "\" cannot be done here: " + std::string(command.enabled.otherwise),
         "");
  command.run(w);
}

void play_at_once(ScriptPlayer& player, Viewer& viewer) {
  scene::Scripting& state = viewer.workspace().scripting;
  player.begin();
  for (;;) {
    const Turn turn = player.next();
    if (turn.what == After::frame) viewer.frame(turn.seconds);
    if (turn.what == After::wait) {
      while (viewer.working() || viewer.will_refine_cage()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        viewer.frame(0);
      }
    }
    if (turn.what == After::end) break;
  }
  for (int i = 0; i < 3; ++i) viewer.frame(usual_frame);  // what was let go of
  state.playing = false;
}

}  // namespace viete::app
