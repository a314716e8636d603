// Records what hands do as a script, frame by frame.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "app/script.h"
#include "platform/input_queue.h"
#include "scene/workspace/workspace.h"
#include "ui/recorder.h"

namespace viete::app {

/// What is there at the start is a session beside the script: what was done before cannot be taken back in a
/// replay. Every frame is written when it is over, so that the script leads up to whatever ends the program.
class ScriptRecorder {
public:
  bool on() const { return out_.has_value(); }
  /// In this folder, under a name with date and time that is not used. The workspace is put as a replay finds
  /// it: the camera rests, no pose is chosen. Throws base::Error; then nothing is recorded.
  void begin(scene::Workspace& workspace, const std::filesystem::path& folder);
  /// Where the script is. Throws base::Error where it could not be written.
  std::filesystem::path end();

  /// An event before the frame that takes it, which is changed to what a script can say exactly. Widgets are
  /// where the last frame has them.
  void take(platform::InputEvent& event, const scene::Workspace& workspace, const ui::Recorder& widgets);
  void take_files(const std::vector<std::filesystem::path>& files);
  void take_size(glm::ivec2 size);
  /// The seconds of a frame that begins, as a script can say them.
  float begin_frame(float seconds);
  /// working: something is being read, bound or made aside. False where the script could not be written: a
  /// full disk.
  [[nodiscard]] bool end_frame(bool working);
  /// That is in the script so far.
  double seconds() const { return seconds_; }

  ScriptRecorder() = default;

private:
  ScriptRecorder(std::filesystem::path file, std::ofstream out);
  void write(const Step& step);
  Place place_of(glm::vec2 at, const scene::Workspace& workspace, const ui::Recorder& widgets);

  std::filesystem::path file_;
  std::optional<std::ofstream> out_;
  std::string line_;  // steps of the frame that runs
  glm::vec2 cursor_{-1, -1};
  std::optional<std::string> held_in_;  // since a button went down: the widget, or "" of the view
  int held_ = 0;                        // buttons
  bool working_ = false;
  double frame_ = 0, seconds_ = 0, last_ = 0;
};

}  // namespace viete::app
