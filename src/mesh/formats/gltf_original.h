// A glTF file kept as it was, to be written again with other positions.
#pragma once

#include <memory>

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

}  // namespace viete::mesh
