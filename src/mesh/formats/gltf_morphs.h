// Reads morph targets of a glTF file, and the animation of their weights.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "mesh/formats/gltf_accessors.h"
#include "mesh/formats/gltf_file.h"
#include "mesh/formats/gltf_scene.h"
#include "mesh/formats/morphs.h"

namespace viete::mesh {

/// The weights of so many targets where nothing plays: the node's, or those of its mesh where it has none.
std::vector<double> default_weights(const GltfJson& document, const GltfPlacement& placement,
                                    std::size_t count);

/// Weighted sum of the offsets of positions, normals or tangents of a piece by its targets: three
/// numbers a vertex; empty where no weight but 0 counts. Throws base::Error.
std::vector<double> morph_differences(const GltfAccessors& accessors, const GltfPiece& piece,
                                      int GltfTarget::*of, std::span<const double> weights);

/// Null where no primitive has targets. Of several animations the first one that plays weights; what moves
/// nodes is not played. Of vertices that are one of the surface (seams) the first one counts. Memory is taken
/// for one moment at a time, whatever the file says. Throws base::Error.
std::shared_ptr<const MorphClip> gltf_morphs(std::shared_ptr<const GltfFile> file,
                                             std::shared_ptr<const GltfMap> map);

}  // namespace viete::mesh
