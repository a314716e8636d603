// From Dear ImGui's input to the pointer and the commands.
#pragma once

#include <imgui.h>

#include "scene/workspace/command.h"
#include "scene/workspace/pointer.h"
#include "scene/workspace/workspace.h"
#include "ui/imgui_bridge.h"

namespace viete::ui {

/// Call once a frame after ImGui::NewFrame(): runs commands for keys and passes the mouse to the pointer.
/// Panels keep captured input (WantCaptureMouse, a text field); a gesture that began in the view continues
/// over panels.
void handle_input(scene::Workspace& workspace, scene::Pointer& pointer);

}  // namespace viete::ui
