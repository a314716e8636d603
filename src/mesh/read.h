// Reads a surface from a file of any known format.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/progress.h"
#include "mesh/attributes.h"
#include "mesh/original.h"
#include "mesh/source.h"
#include "mesh/surface.h"

namespace viete::mesh {

struct ReadResult {
  Surface surface;
  std::string format;                 ///< "OBJ", "PLY ascii", "PLY binary little-endian", "STL binary", ...
  std::vector<std::string> warnings;  ///< one line each, harmless oddities worth a word, with their place
  std::shared_ptr<const Attributes> attributes;  ///< null: nothing but positions and polygons
  std::shared_ptr<const Original> original;      ///< null: it cannot be written again as it was
  std::vector<std::string> comments;  ///< of the file's head, without their mark: at most 64, of 200 bytes
};

/// Format by content first, then by extension. Throws base::Error with file, place and advice; throws
/// base::Cancelled. Never believes a size before the bytes are there: takes memory in proportion to the file.
/// Coordinates past 1e100 are refused, so that volumes stay finite. A file without faces is read as a set of
/// points, with a warning. progress may be null. `played`:
/// who reads it plays its morph targets, which is not so elsewhere and then told.
ReadResult read(const std::filesystem::path& path, base::Progress* progress = nullptr, bool played = false);

/// The same for bytes that are in memory.
ReadResult read(const Source& source);

}  // namespace viete::mesh
