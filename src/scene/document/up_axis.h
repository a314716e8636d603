// Guesses a file's up axis from its content.
#pragma once

#include "scene/document/camera.h"
#include "scene/document/document_state.h"

namespace viete::scene {

/// Y, except Z for STL files (common for CAD and 3D printing), and for a model that stands upright on its
/// lowest points along Z but would topple, or stand on a much smaller base, along Y. glTF defines Y as up.
UpAxis guessed_up(const OpenedSurface& model);

}  // namespace viete::scene
