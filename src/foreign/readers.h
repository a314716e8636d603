// The readers of the program viete-import.
#pragma once

#include <filesystem>
#include <string>

#include "foreign/scene.h"

namespace viete::foreign {

/// The processor time that viete-import may use.
inline constexpr unsigned most_seconds = 600;

/// Reads a foreign file. Prints the progress to the standard error. Throws an exception with the reason.
Scene scene_by_assimp(const std::filesystem::path& file);

/// Returns a GLB with the content of a file with KHR_draco_mesh_compression, EXT_meshopt_compression or, in
/// its first version, KHR_meshopt_compression. All buffers are in the binary chunk; external images stay
/// external. Compressed data is always decoded, also if the file has a fallback. Limits the memory of this
/// process. Throws base::Error and std::bad_alloc.
std::string decompressed_gltf(const std::filesystem::path& file);

}  // namespace viete::foreign
