// Splitting the view of a workspace, and switching between its parts.
#pragma once

#include <cstddef>

#include "lab/field.h"
#include "scene/document/camera.h"
#include "scene/workspace/split.h"
#include "scene/workspace/workspace.h"

namespace viete::scene {

/// Sets the number of views, 1 to 4. New ones use deformers that are not shown yet.
void split_view(Workspace& workspace, std::size_t count);
/// Activates that view and its camera.
void enter_view(Workspace& workspace, std::size_t view);
/// The camera of a view.
CameraPose camera_of(const Workspace& workspace, std::size_t view);
/// The same at the end of a running animation.
CameraPose last_camera_of(const Workspace& workspace, std::size_t view);
/// The split as stored in a session.
SideWays ways_of(const Workspace& workspace);
/// The field shown as colours in a side view, or none.
lab::Field shown_field(const Workspace& workspace, const SideView& side);

}  // namespace viete::scene
