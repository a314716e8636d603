// A script in a window: its cursor is seen, at the speed of the hand that made it; the tour is one.
#pragma once

#include <optional>

#include "app/script_player.h"

namespace viete::app {

class ScriptShow {
public:
  /// The viewer must outlive it.
  explicit ScriptShow(Viewer& viewer) : viewer_(viewer) {}

  /// Opens its files, and plays it; what a hand does ends it. With `by_chapter` it rests after each chapter
  /// until a hand goes on, and what the hand does ends the chapter alone.
  void begin(Script script, bool by_chapter);
  /// The one of this program. Says where it cannot be read.
  void begin_tour();
  bool running() const { return player_.has_value(); }

  /// What a hand does. True if the script has the cursor, and it counts for nothing.
  bool takes(const platform::InputEvent& event);
  /// Before each frame, `seconds` after the last one: takes what a person asks for, hands the viewer what the
  /// script does, and gives the seconds of the frame that comes.
  float step(float seconds);
  /// Ends it; panels and keys are as they were.
  void end();

private:
  void take_request();
  bool is_open();
  float play(float seconds);
  void meet_chapter();
  void take_cursor();
  void give_cursor();
  void rest();

  Viewer& viewer_;
  std::optional<ScriptPlayer> player_;
  scene::Remembered before_;
  bool opened_ = false, by_chapter_ = false, waits_for_work_ = false;
  bool goes_on_ = false;    // to the chapter that comes next
  bool has_edits_ = false;  // the user has unsaved edits, from before the script took the cursor
  double pause_ = 0, played_ = 0;
  glm::vec2 hand_{-1, -1};
};

}  // namespace viete::app
