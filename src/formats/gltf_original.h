// Keeps a glTF file in memory and writes it again with other positions.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formats/gltf_file.h"
#include "formats/gltf_scene.h"
#include "formats/original.h"

namespace viete::formats {

/// The result writes .gltf and .glb. A moved mesh that several nodes use becomes a separate mesh for each
/// node. External buffers are written to the folder of the new file under its name, and never overwrite
/// unrelated files. External images stay in place. If source.owner is set and no position changed, it copies
/// the bytes of `source` if possible.
std::shared_ptr<const Original> gltf_original(const Source& source, GltfFile file, GltfMap map);

/// The rewritten file, before it is stored as JSON or GLB.
struct GltfRewritten {
  GltfJson document;  ///< its buffers have the old URIs and lengths
  std::vector<std::string> buffers;
  std::vector<std::string> notes;  ///< messages for the user, one line each
};

/// Copies the file with new values for positions that differ from `rest`, and for the normals and tangents
/// that depend on them. Values are replaced in place, or put in new accessors if they are shared or not
/// floats. motion: appended to the file's targets and animations; may be null. progress may be null. Throws
/// base::Error and base::Cancelled.
GltfRewritten rewritten_gltf(const GltfFile& file, const GltfMap& map, const mesh::Surface& rest,
                             std::span<const mesh::Point> positions, const MorphMotion* motion = nullptr,
                             base::Progress* progress = nullptr);

}  // namespace viete::formats
