#include "app/file_desk.h"

#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "scene/saving.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

fs::path recovery_folder(const fs::path& state) {
  return state.empty() ? state : state / "recovery";
}
fs::path remembered_file(const fs::path& state) {
  return state / "remembered.json";
}

}  // namespace

FileDesk::FileDesk(const fs::path& state, SavedBindings saved, scene::Workspace& workspace)
    : state_(state), saved_(std::move(saved)), autosave_(recovery_folder(state), errands_) {
  if (state_.empty()) return;
  base::remove_stale_parts(recovery_folder(state_));
  workspace.leftovers = scene::find_leftovers(recovery_folder(state_));
  try {
    workspace.remembered = scene::read_remembered(remembered_file(state_));
  } catch (const base::Error& error) {
    workspace.messages.warn(std::string(error.what()) + "; starting without it");
  }
  workspace.view.hints = workspace.remembered.hints;
  written_ = workspace.remembered;
}

void FileDesk::take_requests(scene::Workspace& w, const std::function<std::vector<mesh::Point>()>& deformed,
                             bool hand_is_free) {
  auto& r = w.requests;
  if (const auto request = std::exchange(r.open, std::nullopt))
    loader_.start(*request, w.document, take_saved());
  if (r.stop_work) loader_.stop();
  if (const auto file = std::exchange(r.save_session, std::nullopt)) scene::save_session(w, *file);
  if (const auto file = std::exchange(r.save_pose, std::nullopt)) scene::save_pose(w, *file);
  if (const auto file = std::exchange(r.save_model, std::nullopt)) {
    if (const auto positions = deformed(); positions.empty()) {
      w.messages.error("The model is not bound yet; save it when it is.");
    } else {
      scene::save_model(w, *file, positions);
    }
  }
  if (const auto file = std::exchange(r.discard, std::nullopt)) discard(w, *file);
  if (hand_is_free) take_loaded(w, false);
}

void FileDesk::take_loaded(scene::Workspace& w, bool wait) {
  auto result = loader_.poll(wait);
  w.loading = loader_.state();
  if (!result) return;
  if (result->opened) {
    if (result->look.surface) look_ = std::move(result->look);
    if (result->bound.binding) bound_ = std::move(result->bound);
    autosave_.follow(w);  // an edit that ended in this very frame is kept before its document goes
    scene::take(w, *std::move(result->opened));
  } else {
    const char* stopped = result->was_binding ? "Stopped binding; everything is as it was."
                                              : "Stopped reading; everything is as it was.";
    w.messages.say(result->problem.empty() ? scene::Severity::info : scene::Severity::error,
                   result->problem.empty() ? stopped : result->problem);
  }
}

SavedBindings FileDesk::take_saved() {
  SavedBindings saved = saved_;
  saved_.named.clear();
  return saved;
}

void FileDesk::keep_binding(const Bound& bound) {
  if (saved_.folder.empty() || bound.seconds < saved_.worth_keeping) return;
  errands_.add([saved = saved_, model = bound.model, cage = bound.cage, tiles = bound.binding->tiles] {
    app::keep_binding(saved, *tiles, *model, *cage);
  });
}

void FileDesk::discard(scene::Workspace& w, const fs::path& file) {
  std::erase_if(w.leftovers, [&](const auto& leftover) { return leftover.file == file; });
  std::error_code code;
  fs::remove(file, code);
  if (code) w.messages.error(file.string() + ": cannot be removed: " + code.message());
}

void FileDesk::keep(scene::Workspace& w) {
  autosave_.follow(w);
  remember(w);
  if (const auto problem = errands_.problem()) w.messages.error(*problem);
}

void FileDesk::remember(scene::Workspace& w) {
  w.remembered.hints = w.remembered.hints && w.view.hints;
  if (state_.empty() || w.remembered == written_) return;
  written_ = w.remembered;
  errands_.add([state = state_, remembered = written_] {
    std::error_code ignored;  // what it is good for is said when the writing fails
    fs::create_directories(state, ignored);
    scene::write_remembered(remembered_file(state), remembered);
  });
}

}  // namespace viete::app
