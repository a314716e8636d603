// Where a click puts the pivot.
#pragma once

#include <optional>

#include "scene/workspace/workspace.h"

namespace viete::scene {

/// The vertex of the posed cage under the cursor, else the place on an edge of it, else that on the model,
/// else the one as far away as what the camera looks at; in the file's coordinates.
mesh::Point pivot_place(const Workspace& workspace, const glm::vec2& cursor);

}  // namespace viete::scene
