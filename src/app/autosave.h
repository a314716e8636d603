// Keeps unsaved edits in a file after each finished edit, so that they survive the end of the program.
#pragma once

#include <filesystem>
#include <future>
#include <optional>
#include <string>

#include "base/background.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

/// $XDG_STATE_HOME/viete, or ~/.local/state/viete where the variable is empty or no absolute path (as the XDG
/// base directory specification says). Empty if there is no home folder either: then nothing is remembered.
std::filesystem::path state_folder();

/// After each finished edit, and each setting that is made after it, the whole session is written aside,
/// replacing the one before; the frame waits for it a millisecond at most. Where one looks from and how the
/// hand works are written once they have rested for half a second. The file goes away when the edits
/// are saved or taken back. When another document is opened over unsaved edits, their file is set aside as a
/// leftover. Recovered work without further edits stays in the file it came from. Whatever way the program
/// ends, the next start finds what is unsaved. Edits are kept
/// once they are written, not before; what cannot be written is a message, and tried again with the next
/// edit.
///
/// Written for the end of the program, not for a power cut: then the file may be the one before.
class Autosave {
public:
  /// Nothing is kept if the folder is empty. The queue must outlive it.
  Autosave(std::filesystem::path folder, base::BackgroundQueue& queue);

  /// Call at the end of each frame. What the mouse is dragging is no edit yet.
  void follow(scene::Workspace& workspace, bool no_drag = true);
  /// True if the edits of this moment have been written.
  bool kept() const { return kept_; }
  /// True if a file was written, or could not be, since follow().
  bool has_news() const;
  /// The edits of this moment, at once: waits until they are written, and tries once more if they could not
  /// be. False if they are not kept: see problem().
  bool keep_now(scene::Workspace& workspace);
  /// The same, and then sets them aside, because another document is about to take their place.
  bool set_aside(scene::Workspace& workspace);
  /// Recovered work without further edits is closed: its file is no longer offered by itself.
  void leave_recovered(scene::Workspace& workspace);
  /// Why the edits of this moment are not kept.
  std::string problem() const;

private:
  struct Moment {
    scene::Revision opened = 0;
    unsigned long edits = 0, saved = 0;
    scene::Revision method = 0;
    scene::ViewOptions view;
    bool unsaved = false;  // which going to another frame may change, too
    friend bool operator==(const Moment&, const Moment&) = default;
  };

  // What goes on changing while the mouse moves, and is no edit.
  struct Surroundings {
    scene::CameraPose camera;
    scene::Handling handling;
    double frame = 1;
    friend bool operator==(const Surroundings&, const Surroundings&) = default;
  };

  void follow_surroundings(scene::Workspace& workspace);
  bool rested() const;
  void write(scene::Workspace& workspace);
  void take_result(scene::Workspace& workspace, double wait_seconds);
  bool move_aside(scene::Workspace& workspace);
  void remove(const std::filesystem::path& leftover);

  std::filesystem::path folder_, file_;
  base::BackgroundQueue& queue_;
  Moment seen_;
  Surroundings around_;
  std::optional<double> around_changed_;  // seconds of wall time; nothing: they are written
  std::future<void> writing_;
  std::filesystem::path replaced_;   // the leftover that is open and goes once its edits are written here
  std::filesystem::path untouched_;  // the leftover that is open without further edits; empty: none
  bool kept_ = false, has_file_ = false;
  std::string problem_;
};

}  // namespace viete::app
