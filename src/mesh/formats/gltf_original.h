// A glTF file kept as it was, to be written again with other positions.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mesh/formats/gltf_file.h"
#include "mesh/formats/gltf_scene.h"
#include "mesh/formats/original.h"

namespace viete::mesh {

/// Writes .gltf and .glb. Positions, normals and tangents of what has moved are replaced where they lie, or
/// by new ones where other parts of the file share them or they are not stored as floats; a mesh that several
/// nodes place, and that has moved, becomes a mesh of its own for each. All else is as in the file. A buffer
/// beside is written beside, under the name of the result, and never over a file that is something else's;
/// images beside stay where they are.
/// At rest it is the bytes of `source`, as far as these outlive the reading.
std::shared_ptr<const Original> gltf_original(const Source& source, GltfFile file, GltfMap map);

/// The file with other positions, before it is put into one form or the other.
struct GltfRewritten {
  GltfJson document;  ///< buffers still have the addresses and lengths of the file
  std::vector<std::string> buffers;
  std::vector<std::string> notes;  ///< what a person should know, one line each
};

/// Everything of the file, but for positions that differ from those of `rest`, and normals and tangents that
/// follow them: where they lie if nothing else in the file shares them, otherwise in new accessors.
/// motion, if there is one, comes behind the file's own, and its targets behind those of the file.
/// progress may be null. Throws base::Error and base::Cancelled.
GltfRewritten rewritten_gltf(const GltfFile& file, const GltfMap& map, const Surface& rest,
                             std::span<const Point> positions, const MorphMotion* motion = nullptr,
                             base::Progress* progress = nullptr);

}  // namespace viete::mesh
