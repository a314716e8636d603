// Keeps a glTF file in memory. Writes the file again with other positions.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/gltf_file.h"
#include "formats/gltf_scene.h"
#include "formats/original.h"

namespace viete::formats {

/// Returns true if the document has Gaussian splats; see Original::capture().
bool is_gltf_capture(const GltfJson& document);

/// Returns an original that writes .gltf and .glb. If several nodes use a moved mesh, each node gets a
/// separate mesh. Writes the external buffers of out.gltf to out.bin, out-2.bin, ..., and never overwrites
/// unrelated files. Copies external images from the folder of the old file and below. If no position changed,
/// writing copies the bytes of `source`. This requires source.owner and no external files.
std::shared_ptr<const Original> gltf_original(const Source& source, GltfFile file, GltfMap map);

/// The rewritten file before conversion to JSON or GLB.
struct GltfRewritten {
  GltfJson document;  ///< the buffers have the old URIs and lengths
  std::vector<std::string> buffers;
  std::vector<std::string> notes;  ///< messages for the user, one line each
};

/// Copies the file with new values for positions that differ from `rest`, and for the normals and tangents
/// that depend on these positions. Replaces values in place. If values are shared or are not floats, adds new
/// accessors instead. Appends `motion` to the file's targets and animations. `motion` and `progress` may be
/// null. Can throw base::Error and base::Cancelled.
GltfRewritten rewritten_gltf(const GltfFile& file, const GltfMap& map, const mesh::Surface& rest,
                             std::span<const mesh::Point> positions, const MorphMotion* motion = nullptr,
                             base::Progress* progress = nullptr);

/// Returns a data URI.
std::string embedded_gltf_uri(std::string_view bytes);

/// Writes a GLB. `bytes` is the binary chunk; if empty, the file has no binary chunk. `others` are further
/// chunks with their headers. If the file exceeds 4 GB, throws base::Error.
void write_glb_chunks(std::string_view json, std::string_view bytes, std::string_view others,
                      TextWriter& out);

}  // namespace viete::formats
