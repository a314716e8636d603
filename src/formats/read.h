// Reads a surface from a file of any known format.
#pragma once

#include <filesystem>

#include "base/progress.h"
#include "formats/original.h"
#include "formats/source.h"
#include "mesh/surface.h"

namespace viete::formats {

/// Detects the format by content, then by extension. Throws base::Error with file, place and advice, and
/// base::Cancelled. Declared sizes are checked against the file size before memory is allocated. Coordinates
/// beyond 1e100 are rejected, so that volumes stay finite. A file without faces gives points and a warning.
/// progress may be null. played: true if the caller plays the morph targets, so that the surface excludes
/// them; otherwise they have their default weights and cause a warning.
ReadResult read(const std::filesystem::path& path, base::Progress* progress = nullptr, bool played = false);

/// Reads from memory.
ReadResult read(const Source& source);

}  // namespace viete::formats
