// From ImGui's input to the pointer and the commands.
#pragma once

#include "scene/workspace/pointer.h"
#include "scene/workspace/workspace.h"

namespace viete::ui {

/// Call once a frame after ImGui::NewFrame(): keys run commands, the mouse goes to the pointer. What a panel
/// wants (WantCaptureMouse, a text field) stays with the panel; a gesture that began in the view goes on over
/// panels.
void handle_input(scene::Workspace& workspace, scene::Pointer& pointer);

}  // namespace viete::ui
