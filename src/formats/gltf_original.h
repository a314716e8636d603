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

/// Returns an original that writes .gltf and .glb. If several nodes use a moved mesh, each node gets a
/// separate mesh. External buffers are written to the folder of the new file under its name, and never
/// overwrite unrelated files. External images stay in place. If source.owner is set and no position changed,
/// the original copies the bytes of `source` if possible.
std::shared_ptr<const Original> gltf_original(const Source& source, GltfFile file, GltfMap map);

/// The rewritten file before conversion to JSON or GLB.
struct GltfRewritten {
  GltfJson document;  ///< the buffers have the old URIs and lengths
  std::vector<std::string> buffers;
  std::vector<std::string> notes;  ///< messages for the user, one line each
};

/// Copies the file with new values for positions that differ from `rest`, and for the normals and tangents
/// that depend on them. Replaces values in place. If values are shared or not floats, adds new accessors
/// instead. motion: is appended to the file's targets and animations; may be null. progress may be null. Can
/// throw base::Error and base::Cancelled.
GltfRewritten rewritten_gltf(const GltfFile& file, const GltfMap& map, const mesh::Surface& rest,
                             std::span<const mesh::Point> positions, const MorphMotion* motion = nullptr,
                             base::Progress* progress = nullptr);

}  // namespace viete::formats
