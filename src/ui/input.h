// From Dear ImGui's input to the pointer and the commands.
#pragma once

#include <imgui.h>

#include "ui/imgui_bridge.h"
#include "workspace/command.h"
#include "workspace/pointer.h"
#include "workspace/workspace.h"

namespace viete::ui {

/// Call once a frame after ImGui::NewFrame(): runs commands for keys and passes the mouse to the pointer.
/// Panels keep captured input (WantCaptureMouse, a text field); a gesture that began in the view continues
/// over panels.
void handle_input(workspace::Workspace& workspace, workspace::Pointer& pointer);

}  // namespace viete::ui
