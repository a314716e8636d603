#include "app/autosave.h"

#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/os.h"
#include "files/session.h"
#include "workspace/open_save.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

constexpr double longest_wait = 1e-3;  // seconds that a frame waits for a write
constexpr double backup_timeout = 10;  // seconds to wait for a backup before the document is closed

void make_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code)
    throw base::Error(folder.string(), "unsaved edits cannot be saved here for recovery: " + code.message(),
                      "save your work often");
}

}  // namespace

fs::path state_folder() {
  const fs::path folder = base::os::state_folder();
  return folder.empty() ? folder : folder / "viete";
}

Autosave::Autosave(fs::path folder, base::BackgroundQueue& queue)
    : folder_(std::move(folder)), queue_(queue) {
  if (!folder_.empty()) file_ = files::recovery_file(folder_);
}

Autosave::Key Autosave::key_of(const workspace::Workspace& w) {
  return {w.files.opened, w.document.history().revision(), w.files.saved.revision(),
          w.document.revisions().method, w.view.options};
}

bool Autosave::is_due(const workspace::Workspace& workspace) const {
  return !folder_.empty() && (base::is_ready(writing_) || seen_ != key_of(workspace));
}

void Autosave::follow(workspace::Workspace& workspace, bool no_drag) {
  if (folder_.empty()) return;
  take_result(workspace, 0);
  const document::Document& document = workspace.document;
  const Key now = key_of(workspace);
  const bool unsaved = no_drag ? workspace::has_unsaved_edits(workspace) : unsaved_;
  if (now == seen_ && unsaved == unsaved_) return;
  const bool other = now.opened != seen_.opened;
  if (other && has_file_) {
    take_result(workspace, backup_timeout);
    if (!move_aside(workspace)) workspace.messages.error(problem_, {"keep edits"});
  }
  if (other) {
    close_recovered(workspace);
    untouched_ = workspace.recovery.from;
    restored_ = untouched_.empty() ? document::DocumentState() : document.state();
    restored_.pose = real_pose(document);
  } else if (!unsaved || (now.edits != seen_.edits && workspace::differs(workspace, restored_))) {
    untouched_.clear();  // a change of the selection is no further edit
  }
  seen_ = now;
  unsaved_ = unsaved;
  kept_ = false;
  writing_ = {};  // ignores the result of an earlier write
  if (!untouched_.empty()) return;
  if (unsaved) {
    write(workspace);
  } else if (!other) {
    remove(std::exchange(workspace.recovery.from, {}));
  }
  take_result(workspace, longest_wait);
}

bool Autosave::keep_now(workspace::Workspace& workspace) {
  follow(workspace);
  if (folder_.empty()) return false;
  std::error_code ignored;
  if (!untouched_.empty() && fs::exists(untouched_, ignored)) return true;
  take_result(workspace, backup_timeout);
  if (!kept_ && !writing_.valid()) {
    write(workspace);
    take_result(workspace, backup_timeout);
  }
  return kept_;
}

bool Autosave::set_aside(workspace::Workspace& workspace) {
  return keep_now(workspace) && move_aside(workspace);
}

std::string Autosave::problem() const {
  if (folder_.empty()) return "There is no home folder for backups.";
  if (writing_.valid()) return file_.string() + ": still being written";
  return problem_;
}

// After writing, deletes the restored recovery file, because the new file contains the same edits.
void Autosave::write(workspace::Workspace& workspace) {
  kept_ = false;
  if (!workspace.preferences.autosave) {
    problem_ = "Autosave is off.";
    return;
  }
  has_file_ = true;
  replaced_ = workspace.recovery.from;
  writing_ = queue_.add(
      [session = workspace::session_of(workspace), folder = folder_, file = file_, old = replaced_] {
        make_folder(folder);
        base::replace_file(file, files::session_text(session, file, false), base::Durability::process);
        std::error_code ignored;
        if (!old.empty()) fs::remove(old, ignored);
      });
}

void Autosave::take_result(workspace::Workspace& workspace, double wait_seconds) {
  if (!base::is_ready(writing_, wait_seconds)) return;
  try {
    writing_.get();
    kept_ = true;
    workspace.messages.succeeded("keep edits");
    if (workspace.recovery.from == replaced_) workspace.recovery.from.clear();
  } catch (const std::exception& error) {
    problem_ = base::message_of(error);
    workspace.messages.error(problem_, {"keep edits"});
  }
}

// Renames the recovery file of the previous document, so that the file is not overwritten.
bool Autosave::move_aside(workspace::Workspace& workspace) {
  kept_ = has_file_ = false;
  std::error_code code;
  if (!fs::exists(file_, code)) return true;
  const fs::path aside = files::set_aside_file(folder_);
  fs::rename(file_, aside, code);
  if (code) {
    problem_ = file_.string() + ": unsaved edits could not be saved for recovery: " + code.message();
    return false;
  }
  workspace.recovery.files.insert(workspace.recovery.files.begin(), files::describe_recovery_file(aside));
  workspace.messages.info("Unsaved edits of " + workspace.recovery.files.front().name +
                          " were saved; File > Restore recovered edits restores them.");
  return true;
}

void Autosave::close_recovered(workspace::Workspace& workspace) {
  if (untouched_.empty()) return;
  const fs::path file = files::mark_restored(std::exchange(untouched_, {}));
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return;
  workspace.recovery.files.insert(workspace.recovery.files.begin(), files::describe_recovery_file(file));
}

// Deletes the recovery file, and the file `leftover` if this path is not empty.
void Autosave::remove(const fs::path& leftover) {
  if (!std::exchange(has_file_, false) && leftover.empty()) return;
  queue_.add([file = file_, leftover] {
    std::error_code ignored;
    fs::remove(file, ignored);
    if (!leftover.empty()) fs::remove(leftover, ignored);
  });
}

}  // namespace viete::app
