// Streaming deformation for other programs: viete deform --stream.
#pragma once

#include <cstdio>

#include "scene/files/export.h"

namespace viete::app {

/// Binds once, then reads poses, three float64 per cage vertex, and writes positions, three float32 per model
/// vertex, both in native byte order, each immediately, until `in` ends. As in the window, turns of the
/// cage's parts continue from the previous pose. Throws base::Error if a pose is invalid or incomplete, or
/// exceeds float, and if writing to `out` fails.
void stream_poses(const scene::Export& what, std::FILE* in, std::FILE* out);

}  // namespace viete::app
