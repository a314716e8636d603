// On the first start the bundled model moves once from rest into a pose: what the program does is seen, and
// every number is alive.
#pragma once

#include <filesystem>
#include <optional>

#include "scene/workspace/workspace.h"

namespace viete::app {

class FirstMotion {
public:
  static constexpr double seconds = 0.6;

  /// pose: of the bundled cage; empty: nothing moves.
  explicit FirstMotion(std::filesystem::path pose) : file_(std::move(pose)) {}

  /// Before a frame, that many seconds after the last one. `ready`: the model follows its cage. Begins where
  /// the hints of the first start are shown and the cage is at rest; what it does is no edit, and is in the
  /// pose when it ends.
  void step(scene::Workspace& workspace, bool ready, double seconds);
  /// A hand comes: at once what it would have come to, or, before it has begun, nothing.
  void finish(scene::Workspace& workspace);
  bool moving() const { return goal_.has_value(); }

private:
  bool begin(scene::Workspace& workspace);
  void place(scene::Workspace& workspace, double share) const;

  std::filesystem::path file_;  // empty once it has begun, or never will
  std::optional<deform::Pose> goal_;
  double passed_ = 0;
};

/// False where motion is not wanted: $VIETE_REDUCED_MOTION is set and not 0.
bool motion_is_wanted();

}  // namespace viete::app
