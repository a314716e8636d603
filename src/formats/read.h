// Reads a surface from a file of any known format.
#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/progress.h"
#include "formats/original.h"
#include "formats/source.h"

namespace viete::formats {

/// Thrown for a glTF file with compressed meshes. foreign::read() reads such files.
struct CompressedGltf : base::Error {
  CompressedGltf(const std::string& file, const std::string& name)
      : Error(file, "the meshes are compressed (" + name + "), which is not supported",
              "export without compression"),
        extension(name) {}

  std::string extension;  ///< the name of the extension that compresses
};

/// Detects the format by content, then by extension. Throws base::Error with file, place and advice, or
/// base::Cancelled. Compares declared sizes with the file size before it allocates memory. Rejects
/// coordinates above 1e100, so that volumes stay finite. If a file has no faces, the result has only points
/// and a warning. `progress` may be null. If `played`, does not apply morph targets, because the caller plays
/// the targets. Otherwise, morph targets have their default weights, and there is a warning.
ReadResult read(const std::filesystem::path& path, base::Progress* progress = nullptr, bool played = false);

/// Reads from memory.
ReadResult read(const Source& source);

}  // namespace viete::formats
