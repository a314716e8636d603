// A glTF file with other positions, before it is put into one form or the other.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "mesh/formats/gltf_file.h"
#include "mesh/formats/gltf_json.h"
#include "mesh/formats/gltf_scene.h"
#include "mesh/formats/morphs.h"
#include "mesh/surface.h"

namespace viete::mesh {

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
