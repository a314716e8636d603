// The bundled model comes with poses and a few seconds of motion of its own.
#pragma once

#include <filesystem>

#include "scene/workspace/workspace.h"

namespace viete::app {

/// Gives what is open the poses and keys of a session, if it is that session's model in its cage and nothing
/// was done to it yet. The session itself is not opened, so that Save asks for a name; no edit, and nothing
/// to save. Says whether it did; false also where the session cannot be read.
bool add_loop(scene::Workspace& workspace, const std::filesystem::path& session);

}  // namespace viete::app
