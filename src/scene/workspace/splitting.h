// The view of a workspace is split, and the hand goes from one part to another.
#pragma once

#include <cstddef>

#include "lab/field.h"
#include "scene/document/camera.h"
#include "scene/workspace/split.h"
#include "scene/workspace/workspace.h"

namespace viete::scene {

/// So many views, 1 to 4. New ones are blended in ways that are not shown yet.
void split_view(Workspace& workspace, std::size_t count);
/// The hand works in that view from now on: the camera is its own.
void enter_view(Workspace& workspace, std::size_t view);
/// That of a view.
CameraPose camera_of(const Workspace& workspace, std::size_t view);
/// The same where it comes to rest, if it is on its way.
CameraPose last_camera_of(const Workspace& workspace, std::size_t view);
/// What a session keeps of the split.
SideWays ways_of(const Workspace& workspace);
/// What a side view shows as colours on the mesh, or none.
lab::Field shown_field(const Workspace& workspace, const SideView& side);

}  // namespace viete::scene
