#include "app/file_desk.h"

#include <algorithm>
#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "mesh/formats/source.h"
#include "scene/files/output.h"
#include "scene/workspace/file_commands.h"
#include "scene/workspace/saving.h"
#include "scene/workspace/taking.h"

namespace viete::app {

namespace fs = std::filesystem;
using Kind = scene::Question::Kind;

namespace {

fs::path recovery_folder(const fs::path& state) {
  return state.empty() ? state : state / "recovery";
}

}  // namespace

fs::path remembered_file(const fs::path& state) {
  return state / "remembered.json";
}

FileDesk::FileDesk(const fs::path& state, SavedBindings saved, scene::Workspace& workspace, fs::path program)
    : state_(state),
      program_(std::move(program)),
      saved_(std::move(saved)),
      autosave_(recovery_folder(state), queue_) {
  workspace.binding_file = saved_.named;
  if (state_.empty()) return;
  base::remove_stale_parts(recovery_folder(state_));
  scene::remove_discarded(recovery_folder(state_));
  workspace.leftovers = scene::find_leftovers(recovery_folder(state_));
  try {
    workspace.remembered = scene::read_remembered(remembered_file(state_));
  } catch (const base::Error& error) {
    workspace.messages.warn(std::string(error.what()) + "; starting without it");
  }
  workspace.view.hints = workspace.remembered.hints;
  workspace.view.dark = workspace.remembered.dark;
  written_ = workspace.remembered;
}

FileDesk::~FileDesk() {
  if (!state_.empty()) scene::remove_discarded(recovery_folder(state_));
}

void FileDesk::take_requests(scene::Workspace& w, bool no_drag) {
  auto& r = w.requests;
  if (const auto answer = std::exchange(r.answer, std::nullopt)) take_answer(w, *answer);
  if (const auto request = std::exchange(r.open, std::nullopt))
    loader_.start(*request, w.document, take_saved());
  if (r.stop_work) loader_.stop();
  if (const auto file = std::exchange(r.save_session, std::nullopt)) save_session(w, *file, false);
  if (const auto file = std::exchange(r.save_pose, std::nullopt)) scene::save_pose(w, *file);
  if (const auto file = std::exchange(r.save_named_pose, std::nullopt); file && scene::chosen_pose(w))
    scene::save_chosen_pose(w, *file);
  if (const auto file = std::exchange(r.save_cage, std::nullopt)) scene::save_cage(w, *file);
  if (const auto file = std::exchange(r.save_model, std::nullopt); file && w.document.is_movable())
    start_export(w, *file);
  if (const auto file = std::exchange(r.save_animation, std::nullopt);
      file && w.document.is_movable() && !w.document.timeline.keys.empty())
    start_animation_export(w, *file);
  if (std::exchange(r.stop_export, false)) exporter_.stop();
  follow_exports(w, false);
  if (const auto file = std::exchange(r.discard, std::nullopt)) discard(w, *file);
  if (std::exchange(r.undo_discard, false)) undo_discard(w);
  sizes_.follow(w);
  go_on_after_saving(w);
  if (std::exchange(r.quit, false) && !w.question) close(w);
  show_exports(w);
  if (no_drag && !w.question) take_loaded(w, false);
}

void FileDesk::start_export(const scene::Workspace& w, const fs::path& file) {
  scene::Export what = scene::export_of(w.document, file);
  what.up = w.camera.pose().up;
  exporter_.add(std::move(what), scene::files_open(w));
}

PictureExport FileDesk::picture_export_of(const scene::Workspace& w, const fs::path& file) const {
  PictureExport what{file, program_, scene::session_of(w)};
  what.session.view.cage = false;
  if (const auto& choice = w.browser.pictures) {
    scene::ViewOptions& view = what.session.view;
    view.cage = choice->cage, view.grid = choice->grid, view.dark = !choice->light;
    what.session.window = {choice->width, choice->height};
    what.panels = choice->panels;
  }
  return what;
}

void FileDesk::start_animation_export(const scene::Workspace& w, const fs::path& file) {
  const std::string extension = mesh::extension_of(file);
  if (extension == "png" || scene::is_video_format(extension))
    return exporter_.add(picture_export_of(w, file), scene::files_open(w));
  scene::AnimationExport what = scene::animation_export_of(w.document, file);
  what.model.up = w.camera.pose().up;
  what.tolerance = w.browser.morphs.tolerance;
  what.normals = w.browser.morphs.normals;
  what.keeps_unfinished = false;  // who stops it here does not go on with it
  exporter_.add(std::move(what), scene::files_open(w));
}

void FileDesk::take_loaded(scene::Workspace& w, bool wait) {
  auto result = loader_.poll(wait);
  w.loading = loader_.state();
  if (!result) return;
  if (result->value) {
    const bool replaces_edits = result->value->opened.document && scene::has_unsaved_edits(w);
    if (!replaces_edits || autosave_.set_aside(w)) return take(w, *std::move(result->value));
    waiting_ = std::move(result->value);
    w.question = scene::ask_before_opening(scene::name_of_work(w), autosave_.problem());
  } else {
    const char* stopped = loader_.was_binding() ? "Stopped binding; everything is as it was."
                                                : "Stopped reading; everything is as it was.";
    w.messages.say(result->stopped ? scene::Severity::info : scene::Severity::error,
                   result->stopped ? stopped : result->problem, {"open"});
  }
}

void FileDesk::take(scene::Workspace& w, Loader::Loaded&& loaded) {
  if (loaded.shading.surface) shading_ = std::move(loaded.shading);
  if (loaded.bound.binding) bound_ = std::move(loaded.bound);
  scene::take(w, std::move(loaded.opened));
}

void FileDesk::close(scene::Workspace& w) {
  closing_ = exporter_.running();
  if (closing_) return;
  if (!scene::has_unsaved_edits(w) || autosave_.keep_now(w)) return go_on(w, Kind::close);
  w.question = scene::ask_before_closing(scene::name_of_work(w), autosave_.problem());
}

void FileDesk::take_answer(scene::Workspace& w, scene::Answer answer) {
  if (!w.question) return;
  const Kind kind = std::exchange(w.question, std::nullopt)->kind;
  if (answer == scene::Answer::cancel) return give_up(w);
  if (kind == Kind::replace) {
    if (answer == scene::Answer::save) return scene::browse_to_save_session(w);
    return save_session(w, w.saved.session, true);
  }
  if (answer == scene::Answer::go_on) return go_on(w, kind);
  w.after_saving = kind;
  scene::save(w);
}

void FileDesk::go_on(scene::Workspace& w, Kind kind) {
  w.after_saving.reset();
  if (kind == Kind::close) closed_ = true;
  if (kind == Kind::open && waiting_) take(w, *std::exchange(waiting_, std::nullopt));
}

// What waits for saving goes on, or is given up where saving was.
void FileDesk::go_on_after_saving(scene::Workspace& w) {
  if (!w.after_saving || w.question) return;
  if (!scene::has_unsaved_edits(w)) return go_on(w, *w.after_saving);
  if (!w.browser.open) give_up(w);
}

void FileDesk::give_up(scene::Workspace& w) {
  w.after_saving.reset();
  if (std::exchange(waiting_, std::nullopt)) w.messages.info("Opened nothing; everything is as it was.");
}

void FileDesk::save_session(scene::Workspace& w, const fs::path& file, bool over_changes) {
  if (!over_changes && scene::changed_on_disk(w, file)) {
    w.question = scene::ask_before_replacing(file);
  } else if (!scene::save_session(w, file) && w.after_saving) {
    w.question =
        scene::ask_after_failed_save(scene::name_of_work(w), *w.after_saving, w.messages.all().back().text);
  }
}

// A window that was about to close goes on with that when all is written, and stays for what went wrong.
void FileDesk::follow_exports(scene::Workspace& w, bool wait) {
  if (!exporter_.follow(w.messages, wait)) closing_ = w.requests.quit = false;  // that is to be read first
  if (!exporter_.running() && std::exchange(closing_, false)) w.requests.quit = true;
}

void FileDesk::show_exports(scene::Workspace& w) {
  w.exporting = exporter_.state();
  if (closing_) w.exporting.what += ", then closing";
}

void FileDesk::finish_exports(scene::Workspace& w) {
  while (exporter_.running()) follow_exports(w, true);
  show_exports(w);
}

SavedBindings FileDesk::take_saved() {
  SavedBindings saved = saved_;
  saved_.named.clear();
  return saved;
}

void FileDesk::keep_binding(const Bound& bound) {
  if (saved_.folder.empty() || bound.seconds < saved_.worth_keeping) return;
  writes_.push_back(
      queue_.add([saved = saved_, model = bound.model, cage = bound.cage, tiles = bound.binding->tiles] {
        app::keep_binding(saved, *tiles, *model, *cage);
      }));
}

void FileDesk::discard(scene::Workspace& w, const fs::path& file) {
  const auto leftover =
      std::find_if(w.leftovers.begin(), w.leftovers.end(), [&](const auto& l) { return l.file == file; });
  if (leftover == w.leftovers.end()) return;
  try {
    w.discarded.push_back(scene::discard(*leftover));
    w.leftovers.erase(leftover);
    w.tell_discarded = true;
  } catch (const base::Error& error) {
    w.messages.error(error.what());
  }
}

void FileDesk::undo_discard(scene::Workspace& w) {
  if (w.discarded.empty()) return;
  try {
    scene::undo_discard(w.discarded.back());
    w.leftovers.insert(w.leftovers.begin(), w.discarded.back().leftover);
    w.discarded.pop_back();
    w.tell_discarded = w.tell_discarded && !w.discarded.empty();
  } catch (const base::Error& error) {
    w.messages.error(error.what());
  }
}

void FileDesk::keep(scene::Workspace& w, bool no_drag) {
  autosave_.follow(w, no_drag);
  remember(w);
  take_written(w);
}

void FileDesk::remember(scene::Workspace& w) {
  w.remembered.hints = w.remembered.hints && w.view.hints;
  if (state_.empty() || w.remembered == written_) return;
  written_ = w.remembered;
  writes_.push_back(queue_.add([state = state_, remembered = written_] {
    std::error_code ignored;  // what it is good for is said when the writing fails
    fs::create_directories(state, ignored);
    scene::write_remembered(remembered_file(state), remembered);
  }));
}

void FileDesk::take_written(scene::Workspace& w) {
  std::erase_if(writes_, [&](auto& write) {
    if (!base::is_ready(write)) return false;
    try {
      write.get();
      w.messages.succeeded("remember");
    } catch (const std::exception& error) {
      w.messages.error(error.what(), {"remember"});
    }
    return true;
  });
}

}  // namespace viete::app
