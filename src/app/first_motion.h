// On the first start the bundled model moves once from rest into a pose, to show what the program does.
#pragma once

#include <filesystem>
#include <optional>

#include "scene/workspace/workspace.h"

namespace viete::app {

class FirstMotion {
public:
  static constexpr double seconds = 0.6;

  /// pose: of the bundled cage; empty: no motion.
  explicit FirstMotion(std::filesystem::path pose) : file_(std::move(pose)) {}

  /// Call before each frame, `seconds` after the last one. `ready`: the model follows its cage. Starts if the
  /// hints of the first start are shown and the cage is at rest; the motion is not an edit, and its end is
  /// the current pose.
  void step(scene::Workspace& workspace, bool ready, double seconds);
  /// On user input: jumps to the end of the motion, or prevents it if it has not started.
  void finish(scene::Workspace& workspace);
  bool moving() const { return goal_.has_value(); }

private:
  bool begin(scene::Workspace& workspace);
  void place(scene::Workspace& workspace, double share) const;

  std::filesystem::path file_;  // empty once started or disabled
  std::optional<deform::Pose> goal_;
  double passed_ = 0;
};

/// False if $VIETE_REDUCED_MOTION is set and not 0.
bool motion_is_wanted();

}  // namespace viete::app
