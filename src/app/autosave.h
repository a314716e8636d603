// Writes unsaved edits to a recovery file after each edit, so that they survive the end of the program.
#pragma once

#include <filesystem>
#include <future>
#include <string>

#include "base/background.h"
#include "workspace/workspace.h"

namespace viete::app {

/// $XDG_STATE_HOME/viete, or ~/.local/state/viete if the variable is empty or not an absolute path (as in the
/// XDG base directory specification). Empty without a home folder: nothing is stored then.
std::filesystem::path state_folder();

/// After each finished edit, and each later change of settings, the whole session is written to a recovery
/// file in the background, replacing the previous one; the frame waits at most a millisecond. Changes of
/// camera, handling and frame alone write nothing. The file is deleted when the edits are saved or
/// undone. Opening another document over unsaved edits renames the file to keep it for recovery. Recovered
/// work without further edits stays in its original file. However the program ends, the next start finds the
/// unsaved work. Edits are safe only after the write finishes; a failed write shows a message and is repeated
/// with the next edit.
///
/// Protects against the end of the program, not power loss: then the file may be the previous one.
class Autosave {
public:
  /// An empty folder disables it. The queue must outlive it.
  Autosave(std::filesystem::path folder, base::BackgroundQueue& queue);

  /// Call at the end of each frame. A running drag is not an edit yet.
  void follow(workspace::Workspace& workspace, bool no_drag = true);
  /// True if the current edits have been written.
  bool kept() const { return kept_; }
  /// True if a write has finished or failed since follow().
  bool has_news() const;
  /// Writes the current edits and waits, with one retry. Returns false if they could not be written: see
  /// problem().
  bool keep_now(workspace::Workspace& workspace);
  /// As keep_now(), then sets the file aside, because another document is about to be opened.
  bool set_aside(workspace::Workspace& workspace);
  /// Closes recovered work without further edits: its file is no longer offered automatically.
  void close_recovered(workspace::Workspace& workspace);
  /// Why the current edits could not be written.
  std::string problem() const;

private:
  struct Moment {
    document::Revision opened = 0;
    unsigned long edits = 0, saved = 0;
    document::Revision method = 0;
    document::ViewOptions view;
    bool unsaved = false;  // also changed by going to another frame
    friend bool operator==(const Moment&, const Moment&) = default;
  };

  void write(workspace::Workspace& workspace);
  void take_result(workspace::Workspace& workspace, double wait_seconds);
  bool move_aside(workspace::Workspace& workspace);
  void remove(const std::filesystem::path& leftover);

  std::filesystem::path folder_, file_;
  base::BackgroundQueue& queue_;
  Moment seen_;
  std::future<void> writing_;
  std::filesystem::path replaced_;   // the open recovery file, deleted once its edits are written here
  std::filesystem::path untouched_;  // the open recovery file without further edits; empty: none
  bool kept_ = false, has_file_ = false;
  std::string problem_;
};

}  // namespace viete::app
