// Guesses a file's up axis from its content.
#pragma once

#include "document/camera.h"
#include "document/document_state.h"

namespace viete::document {

/// Returns Y for glTF and Z for STL, which is common in CAD. For other formats returns Z if the model stands
/// on its lowest points and would fall over or have a much smaller base with Y up; otherwise Y.
UpAxis guessed_up(const OpenedSurface& model);

}  // namespace viete::document
