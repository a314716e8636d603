#include "app/autosave.h"

#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "scene/saving.h"
#include "scene/session.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

constexpr double longest_wait = 1e-3;  // seconds of a frame

void make_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code)
    throw base::Error(folder.string(), "unsaved work cannot be kept here: " + code.message(), "save often");
}

}  // namespace

Autosave::Autosave(fs::path folder, Errands& errands) : folder_(std::move(folder)), errands_(errands) {
  if (!folder_.empty()) file_ = scene::recovery_file(folder_);
}

void Autosave::follow(scene::Workspace& workspace) {
  if (folder_.empty()) return;
  const Moment now{workspace.opened, workspace.document.history.revision(), workspace.saved.revision,
                   workspace.document.weighting()};
  if (now == seen_) return;
  if (now.opened != seen_.opened && written_) set_aside(workspace);
  seen_ = now;
  if (scene::has_unsaved_edits(workspace)) {
    write(workspace);
  } else if (written_) {
    remove(file_);
    written_ = false;
  }
  errands_.wait(longest_wait);
}

// The file of the document that was there before.
void Autosave::set_aside(scene::Workspace& workspace) {
  written_ = false;
  errands_.wait(60);
  const fs::path aside = scene::set_aside_file(folder_);
  std::error_code code;
  fs::rename(file_, aside, code);
  if (code)
    return workspace.messages.error(file_.string() +
                                    ": unsaved work could not be set aside: " + code.message());
  workspace.leftovers.insert(workspace.leftovers.begin(), scene::describe_leftover(aside));
}

// Work that was brought back is removed from where it lay only when it lies here.
void Autosave::write(scene::Workspace& workspace) {
  written_ = true;
  auto session = scene::session_of(workspace);
  const fs::path old = std::exchange(workspace.recovered_from, {});
  std::erase_if(workspace.leftovers, [&](const auto& leftover) { return leftover.file == old; });
  errands_.add([session = std::move(session), folder = folder_, file = file_, old] {
    make_folder(folder);
    base::replace_file(file, scene::session_text(session, file, false), base::Outlives::program);
    std::error_code ignored;
    if (!old.empty()) fs::remove(old, ignored);
  });
}

void Autosave::remove(const fs::path& file) {
  errands_.add([file] {
    std::error_code ignored;
    fs::remove(file, ignored);
  });
}

}  // namespace viete::app
