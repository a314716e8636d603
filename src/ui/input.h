// Passes Dear ImGui's input to the pointer and the commands.
#pragma once

#include <imgui.h>

#include "ui/imgui_bridge.h"
#include "workspace/command.h"
#include "workspace/pointer.h"
#include "workspace/workspace.h"

namespace viete::ui {

/// Runs commands for pressed keys and passes the mouse to the pointer. Call it once a frame after
/// ImGui::NewFrame(). Input over a panel or in a text field belongs to the panel; a gesture that began in the
/// view continues over panels.
void handle_input(workspace::Workspace& workspace, workspace::Pointer& pointer);

}  // namespace viete::ui
