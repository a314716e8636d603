// Which axis of a file points up, as far as its content tells.
#pragma once

#include "scene/document/camera.h"
#include "scene/document/document_state.h"

namespace viete::scene {

/// Y, but Z of STL files, which come from machines and printers, and of a model that stands upright on its
/// lowest points along Z and, along Y, would fall over or stand on much less. glTF says that Y is up.
UpAxis guessed_up(const OpenedSurface& model);

}  // namespace viete::scene
