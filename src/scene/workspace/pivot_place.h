// The position of a pivot placed by a click.
#pragma once

#include <optional>

#include "scene/workspace/workspace.h"

namespace viete::scene {

/// The posed cage's vertex under the cursor, else the point on an edge, else on the model, else at the depth
/// of the camera's target; in file coordinates.
mesh::Point pivot_place(const Workspace& workspace, const glm::vec2& cursor);

}  // namespace viete::scene
