#include "app/script_show.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "app/assets.h"
#include "base/clock.h"
#include "base/error.h"
#include "scene/workspace/saving.h"

namespace viete::app {

namespace {

constexpr double longest_pause = 2;

bool has_opened(const Script& script, const scene::Workspace& w) {
  if (script.open.empty()) return true;
  std::error_code ignored;
  const auto& now = w.saved.session.empty() ? w.document.model.path : w.saved.session;
  return std::filesystem::equivalent(script.open.front(), now, ignored);
}

}  // namespace

void ScriptShow::begin(Script script, bool by_chapter) {
  end();
  scene::Workspace& w = viewer_.workspace();
  w.messages.succeeded("script");
  before_ = w.remembered;
  player_.emplace(std::move(script), viewer_);
  opened_ = waits_for_work_ = false;
  by_chapter_ = by_chapter;
  goes_on_ = true;
  pause_ = 0;
  w.view.hints = w.ask_keys = false;
  try {
    player_->open();
  } catch (const base::Error& error) {
    w.messages.error(error.what(), {"script"});
    return end();
  }
}

void ScriptShow::begin_tour() {
  try {
    begin(read_script(assets_folder() / "tour" / "tour.script"), true);
  } catch (const base::Error& error) {
    viewer_.workspace().messages.error(error.what(), {"script"});
  }
}

void ScriptShow::end() {
  if (!player_) return;
  give_cursor();
  player_.reset();
  scene::Workspace& w = viewer_.workspace();
  w.scripting = {.recording = w.scripting.recording, .recorded = w.scripting.recorded};
  w.remembered.layout = before_.layout, w.remembered.keymap = before_.keymap;
  w.view.dark = w.remembered.dark = before_.dark;
}

void ScriptShow::take_cursor() {
  scene::Workspace& w = viewer_.workspace();
  has_edits_ = scene::has_unsaved_edits(w);
  w.scripting.playing = true, w.scripting.waits = false;
}

// Edits of the script are not the user's: they are not kept as unsaved.
void ScriptShow::give_cursor() {
  scene::Workspace& w = viewer_.workspace();
  player_->release();
  if (w.scripting.playing && !has_edits_) scene::mark_saved(w);
  w.scripting.playing = false;
}

void ScriptShow::rest() {
  scene::Scripting& state = viewer_.workspace().scripting;
  give_cursor();
  state.waits = true;
  viewer_.input().push(platform::InputEvent::move(hand_));
}

bool ScriptShow::takes(const platform::InputEvent& event) {
  using Kind = platform::InputEvent::Kind;
  if (event.kind == Kind::move) hand_ = event.position;
  if (!player_ || !viewer_.workspace().scripting.playing) return false;
  const bool presses = (event.kind == Kind::button || event.kind == Kind::key) && event.down;
  if (!presses && event.kind != Kind::wheel) return true;
  rest();
  if (!by_chapter_) {
    end();
    viewer_.workspace().messages.info("Stopped the replay; what it has done stays.");
  }
  return false;
}

void ScriptShow::take_request() {
  using Request = scene::ScriptRequest;
  scene::Workspace& w = viewer_.workspace();
  if (w.requests.script == Request::none || w.requests.script == Request::record) return;  // the viewer's
  const Request request = std::exchange(w.requests.script, Request::none);
  if (request == Request::tour) return begin_tour();
  if (!player_) return;
  const std::size_t chapter = w.scripting.chapter;
  if (request == Request::end || (request == Request::next && chapter >= w.scripting.of)) return end();
  player_->go_to(request == Request::next ? chapter + 1 : std::max<std::size_t>(2, chapter) - 1);
  goes_on_ = true;
  take_cursor();
  pause_ = 0;
}

// From what is open to what the script begins with: only then has it the cursor.
bool ScriptShow::is_open() {
  scene::Workspace& w = viewer_.workspace();
  if (opened_) return true;
  const bool is_read = !w.requests.open && !viewer_.working();
  const bool deforms = !w.document.has_cage() || (viewer_.deformer() && viewer_.deformer()->ran());
  if (!is_read || !deforms || w.question) return false;
  if (!has_opened(player_->script(), w)) {  // the person wanted to keep what was open
    end();
    return false;
  }
  take_cursor();
  player_->begin();
  w.scripting.of = player_->script().chapters();
  return opened_ = true;
}

void ScriptShow::meet_chapter() {
  scene::Scripting& state = viewer_.workspace().scripting;
  const std::size_t number = player_->chapter();
  if (by_chapter_ && !std::exchange(goes_on_, false)) {
    player_->go_to(number);
    return rest();
  }
  const Step& step = player_->last();
  state.chapter = number;
  state.title = step.text, state.text = step.more;
}

float ScriptShow::step(float seconds) {
  take_request();
  if (!player_ || !is_open() || !viewer_.workspace().scripting.playing) return seconds;
  if (waits_for_work_ && viewer_.working()) return seconds;
  waits_for_work_ = false;
  if (pause_ > 0) {
    pause_ -= seconds;
    return seconds;
  }
  try {
    return play(seconds);
  } catch (const base::Error& error) {
    viewer_.workspace().messages.error(error.what(), {"script"});
    end();
    return seconds;
  }
}

float ScriptShow::play(float seconds) {
  using What = ScriptPlayer::Turn::What;
  const ScriptPlayer::Turn turn = player_->next(std::max(seconds, 1e-3f));
  switch (turn.what) {
    case What::frame: {  // no sooner than it was
      const double early = turn.seconds - (base::wall_seconds() - played_);
      if (early > 0) std::this_thread::sleep_for(std::chrono::duration<double>(std::min(early, 0.1)));
      played_ = base::wall_seconds();
      return turn.seconds;
    }
    case What::wait: waits_for_work_ = true; break;
    case What::pause: pause_ = std::min<double>(turn.seconds, longest_pause); break;
    case What::chapter: meet_chapter(); break;
    case What::end: by_chapter_ ? rest() : end(); break;
  }
  return seconds;
}

}  // namespace viete::app
