// Guesses a file's up axis from its content.
#pragma once

#include "document/camera.h"
#include "document/document_state.h"

namespace viete::document {

/// Y, except Z for STL files (common for CAD and 3D printing), and for a model that stands upright on its
/// lowest points along Z but would topple, or stand on a much smaller base, along Y. glTF defines Y as up.
UpAxis guessed_up(const OpenedSurface& model);

}  // namespace viete::document
