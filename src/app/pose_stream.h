// Poses of a cage that another program sends, and the model for each: viete deform --stream.
#pragma once

#include <cstdio>

#include "scene/files/export.h"

namespace viete::app {

/// Binds once, then reads poses, three float64 a vertex of the cage, and writes positions, three float32 a
/// vertex of the model, both in the machine's byte order, each as soon as it is made, until `in` ends. As the
/// window draws: each part of the cage turns on from the pose before. Throws base::Error where a pose is none
/// or ends before it is whole, or leads beyond floats, and where `out` takes no more.
void stream_poses(const scene::Export& what, std::FILE* in, std::FILE* out);

}  // namespace viete::app
