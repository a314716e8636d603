// A script moves a viewer's hands.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "app/script.h"
#include "app/viewer.h"

namespace viete::app {

/// Hands over events step by step; who has the viewer draws its frames. What a script asks to be written to
/// files is left out, see Viewer::take_requests(). The viewer must outlive it.
class ScriptPlayer {
public:
  struct Turn {
    enum class What { frame, wait, pause, chapter, end } what;
    float seconds = 0;  ///< of a frame or pause
  };

  ScriptPlayer(Script script, Viewer& viewer) : script_(std::move(script)), viewer_(viewer) {}

  const Script& script() const { return script_; }
  /// Asks for the files, and puts panels and brush as they were; the frames that follow open them.
  void open();
  /// Once they are open.
  void begin();
  /// What is to be done before it is called again; what has no frames of its own gets some that are so long.
  /// Throws base::Error naming file and line.
  Turn next(float seconds = 1.0f / 64);
  /// Where chapter `number` begins, from 1; one that is not there: the end.
  void go_to(std::size_t number);
  /// The one that has begun, from 1; 0: none.
  std::size_t chapter() const;
  /// What was done last.
  const Step& last() const { return script_.steps[at_ - 1]; }
  /// Lets go of buttons and keys.
  void release();

private:
  [[noreturn]] void fail(const Step& step, const std::string& problem, const std::string& advice) const;
  void take(const Step& step);
  std::optional<Turn> reach(const Step& step);
  glm::vec2 resolve(const Step& step) const;
  Turn glide(const Step& step, float seconds);
  void move(glm::vec2 to);
  void push(platform::InputEvent event) { viewer_.input().push(std::move(event)); }

  Script script_;
  Viewer& viewer_;
  std::size_t at_ = 0;  // the step that comes next
  int repeated_ = 0;    // how often it was done
  int looked_ = 0;      // frames in which its widget was looked for
  double glided_ = 0;   // seconds of it
  glm::vec2 cursor_{0, 0}, from_{0, 0}, to_{0, 0};
  std::vector<platform::InputEvent> held_;  // what lets go of them
};

/// All of it without a window, frame by frame and as fast as that goes. Throws base::Error.
void play_at_once(ScriptPlayer& player, Viewer& viewer);

}  // namespace viete::app
