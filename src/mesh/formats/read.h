// Reads a surface from a file of any known format.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/progress.h"
#include "mesh/formats/original.h"
#include "mesh/formats/source.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// Format by content first, then by extension. Throws base::Error with file, place and advice; throws
/// base::Cancelled. Never believes a size before the bytes are there: takes memory in proportion to the file.
/// Coordinates past 1e100 are refused, so that volumes stay finite. A file without faces is read as a set of
/// points, with a warning. progress may be null. `played`:
/// who reads it plays its morph targets: the surface is that without them; elsewhere they have their default
/// weights, with a warning.
ReadResult read(const std::filesystem::path& path, base::Progress* progress = nullptr, bool played = false);

/// The same for bytes that are in memory.
ReadResult read(const Source& source);

}  // namespace viete::mesh
