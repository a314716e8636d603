// Writes unsaved edits to a recovery file after each edit. After a crash, these edits can be restored.
#pragma once

#include <filesystem>
#include <future>
#include <string>

#include "base/background.h"
#include "workspace/workspace.h"

namespace viete::app {

/// Returns $XDG_STATE_HOME/viete. If this variable is not an absolute path, returns ~/.local/state/viete (XDG
/// base directory specification). Without a home folder, returns an empty path: nothing is stored.
std::filesystem::path state_folder();

/// Keeps unsaved edits in a recovery file, which survives a crash, but perhaps not a power failure.
/// - Each edit or change of settings writes the file in the background. A frame waits at most a millisecond.
/// - A change of the camera, transform settings or current frame does not write the file.
/// - If all edits are saved or undone, deletes the file. If another document is opened, renames the file.
/// - Recovered edits stay in their original file until the next edit.
/// - If writing fails, shows a message and tries again after the next edit.
class Autosave {
public:
  /// An empty folder disables autosave. The queue must outlive this object.
  Autosave(std::filesystem::path folder, base::BackgroundQueue& queue);

  /// Call at the end of each frame. `no_drag` must be false during a drag: a drag is not a finished edit.
  void follow(workspace::Workspace& workspace, bool no_drag = true);
  /// True if the current edits have been written.
  bool kept() const { return kept_; }
  /// True if follow() would do something now, except during a drag.
  bool is_due(const workspace::Workspace& workspace) const;
  /// Writes the current edits and waits. Returns false if this fails twice or takes too long: see problem().
  bool keep_now(workspace::Workspace& workspace);
  /// Calls keep_now(), then renames the file to keep it. Call before another document is opened.
  bool set_aside(workspace::Workspace& workspace);
  /// Call when a document is closed. Recovered edits that are unchanged are not offered at the next start.
  void close_recovered(workspace::Workspace& workspace);
  /// The reason why the current edits could not be written.
  std::string problem() const;

private:
  // The input of a recovery file.
  struct Key {
    document::Revision opened = 0;
    unsigned long edits = 0, saved = 0;
    document::Revision method = 0;
    document::ViewOptions view;
    friend bool operator==(const Key&, const Key&) = default;
  };
  static Key key_of(const workspace::Workspace& workspace);

  void write(workspace::Workspace& workspace);
  void take_result(workspace::Workspace& workspace, double wait_seconds);
  bool move_aside(workspace::Workspace& workspace);
  void remove(const std::filesystem::path& leftover);

  std::filesystem::path folder_, file_;
  base::BackgroundQueue& queue_;
  Key seen_;
  bool unsaved_ = false;  // there were unsaved edits when follow() was last called without a drag
  std::future<void> writing_;
  std::filesystem::path replaced_;    // the restored file that the current write deletes; empty if none
  std::filesystem::path untouched_;   // the restored file while there are no further edits; empty if none
  document::DocumentState restored_;  // the edits in this file
  bool kept_ = false, has_file_ = false;
  std::string problem_;
};

}  // namespace viete::app
