// Reads morph targets of a glTF file, and the animation of their weights.
#pragma once

#include <memory>

#include "mesh/formats/gltf_file.h"
#include "mesh/formats/gltf_scene.h"
#include "mesh/formats/morphs.h"

namespace viete::mesh {

/// Null where no primitive has targets. Of several animations the first one that plays weights; what moves
/// nodes is not played. Of vertices that are one of the surface (seams) the first one counts. Memory is taken
/// for one moment at a time, whatever the file says. Throws base::Error.
std::shared_ptr<const MorphClip> gltf_morphs(std::shared_ptr<const GltfFile> file,
                                             std::shared_ptr<const GltfMap> map);

}  // namespace viete::mesh
