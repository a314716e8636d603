#include "app/file_desk.h"

#include <stdlib.h>

#include <algorithm>
#include <system_error>

#include "app/child_process.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "base/file_bytes.h"
#include "base/numbered_files.h"
#include "base/process.h"
#include "base/text.h"
#include "files/output.h"
#include "workspace/open_save.h"

namespace viete::app {

namespace fs = std::filesystem;
using Kind = workspace::Question::Kind;

namespace {

// Copies a request and makes the copy remove the fins of the cage. `cage`: the file of the cage.
files::OpenRequest without_fins(files::OpenRequest request, const std::string& cage) {
  using What = files::OpenRequest::What;
  request.without_fins = true;
  if (request.what != What::dropped) return request;
  if (request.files.front() == cage) std::swap(request.files.front(), request.files.back());
  request.what = request.files.size() == 1 ? What::cage : What::model;
  return request;
}

Loaded load(const files::OpenRequest& request, const document::Document& current, std::size_t moving,
            base::StepProgress& progress) {
  Loaded loaded;
  try {
    loaded.opened = files::open_files(request, current, &progress);
  } catch (const files::SessionFileError& error) {
    loaded.question = workspace::ask_to_locate(error.key, error.problem());
    loaded.request = request;
  } catch (const pose::FinError& error) {
    loaded.question = workspace::ask_to_remove_fins(error.place() + ": " + error.problem());
    loaded.request = without_fins(request, error.place());
  }
  if (loaded.question) return loaded;
  const files::Opened& opened = loaded.opened;
  files::check_drawable(opened);
  if (!opened.document) return loaded;
  const document::Document& document = *opened.document;
  if (document.model().surface != current.model().surface) {
    progress.section(0.8, 1);
    loaded.shading = shading_of(document.model(), moving);
  }
  if (!document.has_cage()) return loaded;
  progress.step(document::binding_plan(document, document.deformer().weighting));
  loaded.bound = app::bind({document.model().surface, document.cage(), document.model().splats},
                           document.deformer(), document.method(), {}, progress, loaded.shading.draft);
  return loaded;
}

fs::path recovery_folder(const fs::path& state) {
  return state.empty() ? state : state / "recovery";
}

// Draws and writes pictures in a child process. Returns notes for the user, one line each. Throws base::Error
// with the message of the child process, and base::Cancelled. Thread-safe.
std::vector<std::string> write_pictures_in_child(const PictureExport& what, base::Progress& progress) {
  const ScratchFolder scratch;
  const fs::path session = scratch.path() / "animation.viete";
  base::replace_file(session, files::session_text(what.session, session), base::Durability::process);
  std::vector<std::string> words{what.program.string(), "animate", session.string(), "-o",
                                 fs::absolute(what.file).string()};
  if (what.session.view.cage) words.push_back("--show-cage");
  if (what.panels) words.push_back("--panels");
  if (what.replaces) words.push_back("--force");
  return run_child(words, progress);
}

}  // namespace

void start_loading(Loader& loader, const files::OpenRequest& request, const document::Document& current,
                   std::size_t moving) {
  const auto& files = request.files;
  loader.start([request, current = current.without_history(),
                moving](base::StepProgress& progress) { return load(request, current, moving, progress); },
               "Reading " + (files.empty() ? "" : files.front().filename().string()));
}

void Exporter::add(files::Export what, std::vector<std::string> shown_notes) {
  const std::filesystem::path file = what.file;
  add({file, "no file was changed",
       [what = std::move(what)](base::Progress& progress) {
         return Written{"", files::write_deformed(what, &progress)};
       },
       std::move(shown_notes)});
}

void Exporter::add(files::AnimationExport what, std::vector<std::string> shown_notes) {
  const std::filesystem::path file = what.model.file;
  const bool numbered = base::NumberedName::is_pattern(file);
  add({file, numbered ? "frames written so far are complete" : "no file was changed",
       [what = std::move(what)](base::Progress& progress) {
         files::AnimationReport report = files::write_animation(what, &progress);
         const std::string name = what.model.file.filename().string();
         return Written{name + ": " + report.summary, std::move(report.notes)};
       },
       std::move(shown_notes)});
}

void Exporter::add(PictureExport what) {
  const std::filesystem::path file = what.file;
  const char* const stopped =
      files::is_film(file) ? "no file was changed" : "pictures written so far are complete";
  add({file, stopped, [what = std::move(what)](base::Progress& progress) {
         return Written{"", write_pictures_in_child(what, progress)};
       }});
}

void Exporter::add(Work work) {
  waiting_.push_back(std::move(work));
  if (!running()) start_next();
}

void Exporter::start_next() {
  if (waiting_.empty()) return;
  now_ = std::move(waiting_.front());
  waiting_.pop_front();
  job_.start(std::move(now_.write), "Exporting " + now_.file.filename().string());
}

workspace::WorkState Exporter::state() const {
  if (!running()) return {};
  workspace::WorkState state = job_.state();
  if (!waiting_.empty()) state.what += ", then " + waiting_.front().file.filename().string();
  return state;
}

// Shows one message. Notes and the summary are only listed in the Messages panel.
void Exporter::tell(workspace::Messages& messages, Written&& written) const {
  std::erase_if(written.notes,
                [&](const std::string& note) { return std::ranges::count(now_.shown_notes, note) > 0; });
  std::string command;  // makes a film of the pictures
  std::erase_if(written.notes, [&](const std::string& note) {
    const bool found = note.starts_with("ffmpeg ");
    if (found) command = note;
    return found;
  });
  if (!written.summary.empty()) messages.log(workspace::Severity::info, written.summary);
  for (const auto& note : written.notes) messages.log(workspace::Severity::warning, note);
  if (!command.empty()) messages.log(workspace::Severity::info, command);
  std::string text = "Saved " + now_.file.filename().string();
  if (!written.notes.empty()) text += " (" + base::counted(written.notes.size(), "note") + ", see Messages)";
  messages.info(text + ".");
}

std::optional<Exporter::Failure> Exporter::follow(workspace::Messages& messages, bool wait) {
  auto result = job_.poll(wait);
  if (!result) return std::nullopt;
  std::optional<Failure> failure;
  if (result->value) {
    messages.succeeded("export");
    tell(messages, *std::move(result->value));
  } else if (result->stopped) {
    messages.info("Cancelled exporting " + now_.file.filename().string() + "; " + now_.stopped + ".");
  } else {
    failure = {now_.file, result->problem};
  }
  start_next();
  return failure;
}

fs::path preferences_file(const fs::path& state) {
  return state / "remembered.json";
}

FileDesk::FileDesk(const fs::path& state, workspace::Workspace& workspace, fs::path program,
                   const base::Wake& wake)
    : state_(state),
      program_(std::move(program)),
      loader_(wake),
      exporter_(wake),
      queue_(wake),
      autosave_(recovery_folder(state), queue_) {
  if (state_.empty()) return;
  base::remove_stale_parts(recovery_folder(state_));
  workspace.recovery.files = files::find_recovery_files(recovery_folder(state_));
  workspace.recovery.offered = !std::ranges::all_of(workspace.recovery.files, &files::RecoveryFile::restored);
  try {
    workspace.preferences = workspace::read_preferences(preferences_file(state_));
  } catch (const base::Error& error) {
    workspace.messages.warn(std::string(error.what()) + "; using the default preferences");
  }
  workspace.view.options.hints = workspace.preferences.hints;
  workspace.view.options.dark = workspace.preferences.dark;
  written_ = workspace.preferences;
}

void FileDesk::open(workspace::Workspace& w, const files::OpenRequest& request) {
  reading_ = request.files.empty() ? fs::path() : request.files.front();
  start_loading(loader_, request, w.document, w.about.moving_triangles);
}

void FileDesk::save(workspace::Workspace& w, const workspace::SaveFile& wish) {
  using Content = workspace::SaveFile::Content;
  const bool movable = w.document.is_movable();
  switch (wish.content) {
    case Content::session: return save_session(w, wish.file);
    case Content::pose: workspace::save_pose(w, wish.file); return;
    case Content::cage: workspace::save_cage(w, wish.file); return;
    case Content::model:
      if (movable) export_to(w, wish.file, &FileDesk::start_export);
      return;
    case Content::animation:
      if (movable && w.document.timeline().has_poses())
        export_to(w, wish.file, &FileDesk::start_animation_export);
      return;
  }
}

bool FileDesk::is_due(const workspace::Workspace& w, bool no_drag) const {
  return exporter_.has_result() || continues(w) || (takes_loaded(w, no_drag) && loader_.has_result()) ||
         ends_dialog(w);
}

bool FileDesk::follow(workspace::Workspace& w, bool no_drag) {
  bool news = follow_exports(w, false);
  if (continues(w)) continue_after_saving(w);
  show_exports(w);
  if (takes_loaded(w, no_drag)) news |= take_loaded(w, false);
  if (ends_dialog(w)) end_dialog(w.files.browser);
  return news;
}

// True if a dialog's file has been read or written, or if a progress bar should replace the dialog.
bool FileDesk::ends_dialog(const workspace::Workspace& w) const {
  constexpr double short_time = 0.5;
  const workspace::FileBrowser& browser = w.files.browser;
  if (browser.asked.empty()) return false;
  if (exporter_.running()) return browser.open;
  if (loader_.running()) return browser.open && w.jobs.loading.age > short_time;
  return !w.files.question;
}

void FileDesk::end_dialog(workspace::FileBrowser& browser) {
  browser.open = false;
  if (!exporter_.running() && !loader_.running()) browser.asked.clear();
}

void FileDesk::export_to(workspace::Workspace& w, const fs::path& file, StartExport start) {
  try {
    (this->*start)(w, file);
  } catch (const base::Error& error) {
    report_failed_export(w, file, error.what());
  }
}

// The user must read the error before the program closes.
void FileDesk::report_failed_export(workspace::Workspace& w, const fs::path& file, const std::string& why) {
  workspace::report_refusal(w, file, why, "export");
  closing_ = false;
  w.jobs.wishes.drop<workspace::CloseProgram>();
}

void FileDesk::start_export(const workspace::Workspace& w, const fs::path& file) {
  files::Export what = files::export_of(w.document, file);
  what.up = w.view.camera.pose().up;
  files::check_output(file, files::Content::surface, workspace::files_open(w), files::Force::none);
  exporter_.add(std::move(what), w.frame.notes);
}

PictureExport FileDesk::picture_export_of(const workspace::Workspace& w, const fs::path& file) const {
  PictureExport what{file, program_, workspace::session_of(w)};
  what.session.view.cage = false;
  if (const auto& choice = w.files.browser.pictures) {
    document::ViewOptions& view = what.session.view;
    view.cage = choice->cage;
    view.grid = choice->grid;
    view.dark = !choice->light;
    what.session.window = {choice->width, choice->height};
    what.panels = choice->panels;
  }
  what.replaces = w.files.browser.asked == file && w.files.browser.replaces();
  return what;
}

void FileDesk::start_animation_export(const workspace::Workspace& w, const fs::path& file) {
  files::AnimationExport what = files::animation_export_of(w.document, file);
  files::check_output(file, {what.first, what.last}, workspace::files_open(w), files::Force::none);
  const workspace::FileBrowser& browser = w.files.browser;
  const bool confirmed = browser.asked == file && browser.replaces();  // the browser has asked the user
  what.force = confirmed ? files::Force::given : files::Force::none;
  if (base::NumberedName::is_pattern(file))
    files::check_frames_are_new(base::NumberedName(file), what.frames(), what.force);
  if (base::extension_of(file) == "png" || files::is_film(file))
    return exporter_.add(picture_export_of(w, file));
  what.model.up = w.view.camera.pose().up;
  what.tolerance = w.files.browser.morphs.tolerance;
  what.normals = w.files.browser.morphs.normals;
  exporter_.add(std::move(what), w.frame.notes);
}

bool FileDesk::take_loaded(workspace::Workspace& w, bool wait) {
  auto result = loader_.poll(wait);
  w.jobs.loading = loader_.state();
  if (!result) return false;
  if (result->value && result->value->question) {
    w.files.question = std::move(result->value->question);
    w.files.unopened = std::move(result->value->request);
  } else if (result->value) {
    const bool replaces_edits = result->value->opened.document && workspace::has_unsaved_edits(w);
    waiting_ = std::move(result->value);
    if (!replaces_edits || autosave_.set_aside(w)) {
      opened_ = std::exchange(waiting_, std::nullopt);
    } else {
      w.files.question = workspace::ask_before_opening(workspace::name_of_work(w), autosave_.problem());
    }
  } else if (result->stopped) {
    w.messages.info("Cancelled opening; nothing was changed.", {"open"});
  } else {
    workspace::report_refusal(w, reading_, result->problem, "open");
  }
  return true;
}

void FileDesk::close(workspace::Workspace& w) {
  if (w.files.question) return;
  closing_ = exporter_.running();
  if (closing_) return;
  if (!workspace::has_unsaved_edits(w) || autosave_.keep_now(w)) return proceed(w, Kind::close);
  w.files.question = workspace::ask_before_closing(workspace::name_of_work(w), autosave_.problem());
}

void FileDesk::answer(workspace::Workspace& w, workspace::Answer answer) {
  if (!w.files.question) return;
  const Kind kind = std::exchange(w.files.question, std::nullopt)->kind;
  if (answer == workspace::Answer::cancel) return give_up(w);
  if (kind == Kind::locate_model) return browse_to_locate(w, workspace::FileBrowser::Purpose::locate_model);
  if (kind == Kind::locate_cage) return browse_to_locate(w, workspace::FileBrowser::Purpose::locate_cage);
  if (kind == Kind::fins) {
    if (const auto request = std::exchange(w.files.unopened, std::nullopt)) open(w, *request);
    return;
  }
  if (kind == Kind::discard) return discard(w);
  if (kind == Kind::replace) {
    if (answer == workspace::Answer::save) return workspace::browse_to_save_session(w);
    return save_session(w, w.files.saved.session, kind);
  }
  if (kind == Kind::moved) {
    const bool saved = answer != workspace::Answer::save || workspace::save_moved_files(w, session_);
    return saved ? save_session(w, session_, kind) : give_up(w);
  }
  if (answer == workspace::Answer::proceed) return proceed(w, kind);
  w.files.after_saving = kind;
  workspace::save(w);
}

void FileDesk::proceed(workspace::Workspace& w, Kind kind) {
  w.files.after_saving.reset();
  if (kind == Kind::close) {
    autosave_.close_recovered(w);
    closed_ = true;
  }
  if (kind == Kind::open) opened_ = std::exchange(waiting_, std::nullopt);
}

// True if the question's action must continue after saving, or be cancelled with it.
bool FileDesk::continues(const workspace::Workspace& w) const {
  return w.files.after_saving && !w.files.question &&
         (!workspace::has_unsaved_edits(w) || !w.files.browser.open);
}

void FileDesk::continue_after_saving(workspace::Workspace& w) {
  if (!workspace::has_unsaved_edits(w)) return proceed(w, *w.files.after_saving);
  give_up(w);
}

void FileDesk::give_up(workspace::Workspace& w) {
  w.files.after_saving.reset();
  const bool unopened = std::exchange(w.files.unopened, std::nullopt).has_value();
  if (std::exchange(waiting_, std::nullopt) || unopened)
    w.messages.info("Cancelled opening; nothing was changed.");
}

// `answered` is the last question that the user has answered for this file.
void FileDesk::save_session(workspace::Workspace& w, const fs::path& file, std::optional<Kind> answered) {
  const std::string moved = answered == Kind::moved ? "" : workspace::moved_files(w);
  session_ = file;
  if (!answered && workspace::changed_on_disk(w, file)) {
    w.files.question = workspace::ask_before_replacing(file);
  } else if (!moved.empty()) {
    w.files.question = workspace::ask_to_save_meshes(moved);
  } else if (!workspace::save_session(w, file) && w.files.after_saving && !w.files.browser.open) {
    w.files.question = workspace::ask_after_failed_save(workspace::name_of_work(w), *w.files.after_saving,
                                                        w.messages.all().back().text);
  }
}

// Continues with closing after all exports. If an export fails, cancels closing.
bool FileDesk::follow_exports(workspace::Workspace& w, bool wait) {
  const bool news = wait || exporter_.has_result();
  if (const auto failure = exporter_.follow(w.messages, wait))
    report_failed_export(w, failure->file, failure->problem);
  if (!exporter_.running() && std::exchange(closing_, false)) close(w);
  return news;
}

void FileDesk::show_exports(workspace::Workspace& w) {
  w.jobs.exporting = exporter_.state();
  if (closing_) w.jobs.exporting.what += ", then closing";
}

void FileDesk::finish_exports(workspace::Workspace& w) {
  while (exporter_.running()) follow_exports(w, true);
  show_exports(w);
}

void FileDesk::discard(workspace::Workspace& w) {
  const std::vector<files::RecoveryFile> offers = w.recovery.offers();
  std::erase_if(w.recovery.files, [&](const files::RecoveryFile& leftover) {
    std::error_code code;
    if (std::ranges::find(offers, leftover.file, &files::RecoveryFile::file) == offers.end()) return false;
    if (fs::remove(leftover.file, code) || !code) return true;
    w.messages.error(base::Error(leftover.file.string(), "cannot be deleted: " + code.message()).what(),
                     {"discard"});
    return false;
  });
  if (w.recovery.files.empty()) w.messages.succeeded("discard");
  w.recovery.offered = !std::ranges::all_of(w.recovery.files, &files::RecoveryFile::restored);
}

void FileDesk::keep(workspace::Workspace& w, bool no_drag) {
  autosave_.follow(w, no_drag);
  remember(w);
  take_written(w);
}

bool FileDesk::keeps(const workspace::Workspace& w) const {
  const bool is_new = !state_.empty() && w.preferences != written_;
  return is_new || autosave_.is_due(w) ||
         std::ranges::any_of(writes_, [](const auto& write) { return base::is_ready(write); });
}

void FileDesk::remember(workspace::Workspace& w) {
  w.preferences.hints = w.preferences.hints && w.view.options.hints;
  if (state_.empty() || w.preferences == written_) return;
  written_ = w.preferences;
  writes_.push_back(queue_.add([state = state_, preferences = written_] {
    std::error_code ignored;  // write_preferences() reports a missing folder
    fs::create_directories(state, ignored);
    workspace::write_preferences(preferences_file(state), preferences);
  }));
}

void FileDesk::take_written(workspace::Workspace& w) {
  std::erase_if(writes_, [&](auto& write) {
    if (!base::is_ready(write)) return false;
    try {
      write.get();
      w.messages.succeeded("remember");
    } catch (const std::exception& error) {
      w.messages.error(base::message_of(error), {"remember"});
    }
    return true;
  });
}

}  // namespace viete::app
