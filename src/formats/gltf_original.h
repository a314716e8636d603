// A glTF file kept as read, to be written again with other positions.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formats/gltf_file.h"
#include "formats/gltf_scene.h"
#include "formats/original.h"

namespace viete::formats {

/// Writes .gltf and .glb. Positions, normals and tangents of moved vertices are replaced in place, or by new
/// accessors if they are shared or not stored as floats. A moved mesh used by several nodes becomes a
/// separate mesh for each. Everything else stays. External buffers are written beside the result under its
/// name and never overwrite unrelated files; external images stay in place. Without any change it writes the
/// bytes of `source`, if these outlive the reading.
std::shared_ptr<const Original> gltf_original(const Source& source, GltfFile file, GltfMap map);

/// The rewritten file, before it is stored as JSON or GLB.
struct GltfRewritten {
  GltfJson document;  ///< buffers still have the file's URIs and lengths
  std::vector<std::string> buffers;
  std::vector<std::string> notes;  ///< messages for the user, one line each
};

/// Copies the file with new values for positions that differ from `rest` and for the normals and tangents
/// that depend on them: in place if not shared, otherwise in new accessors. motion (may be null): appended
/// after the file's own targets and animations. progress may be null. Throws base::Error and base::Cancelled.
GltfRewritten rewritten_gltf(const GltfFile& file, const GltfMap& map, const mesh::Surface& rest,
                             std::span<const mesh::Point> positions, const MorphMotion* motion = nullptr,
                             base::Progress* progress = nullptr);

}  // namespace viete::formats
