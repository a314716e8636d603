// Keeps unsaved edits in a file from one finished edit to the next, so that the end of the program cannot
// take them along.
#pragma once

#include <filesystem>

#include "app/errands.h"
#include "scene/workspace.h"

namespace viete::app {

/// After each finished edit the whole session is written aside, replacing the one before; the frame waits for
/// it a millisecond at most. The file goes away when the edits are saved or taken back. When another document
/// is opened over unsaved edits, their file is set aside and offered as a leftover. Whatever way the program
/// ends, the next start finds what is unsaved.
///
/// Written for the end of the program, not for a power cut: then the file may be the one before.
class Autosave {
public:
  /// Nothing is kept if the folder is empty. The errands must be done before the program ends.
  Autosave(std::filesystem::path folder, Errands& errands);

  /// Call at the end of each frame.
  void follow(scene::Workspace& workspace);
  /// True if the edits of this moment are on their way into the file, or there.
  bool keeping() const { return written_; }

private:
  struct Moment {
    scene::Revision opened = 0;
    unsigned long edits = 0, saved = 0;
    deform::Weighting weighting{deform::Coordinates::face};  // no edit of the history
    friend bool operator==(const Moment&, const Moment&) = default;
  };

  void set_aside(scene::Workspace& workspace);
  void write(scene::Workspace& workspace);
  void remove(const std::filesystem::path& file);

  std::filesystem::path folder_, file_;
  Errands& errands_;
  Moment seen_;
  bool written_ = false;
};

}  // namespace viete::app
