// Reads a surface from a file of any known format.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/progress.h"
#include "formats/original.h"
#include "formats/source.h"
#include "mesh/surface.h"

namespace viete::formats {

/// Detects the format by content, then by extension. Throws base::Error with file, place and advice; throws
/// base::Cancelled. Memory is proportional to the file size: declared sizes are checked against the bytes.
/// Rejects coordinates beyond 1e100, so that volumes stay finite. A file without faces is read as points,
/// with a warning. progress may be null. `played`: the caller plays the morph targets, and the surface
/// excludes them; otherwise they have their default weights, with a warning.
ReadResult read(const std::filesystem::path& path, base::Progress* progress = nullptr, bool played = false);

/// Reads from memory.
ReadResult read(const Source& source);

}  // namespace viete::formats
