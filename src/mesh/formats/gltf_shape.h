// Whether the JSON of a glTF file has the form that the format asks for.
#pragma once

#include <string>

#include "mesh/formats/gltf_json.h"

namespace viete::mesh {

/// Of what a surface is made of: scenes, nodes, meshes, accessors and buffer views, with the types of their
/// members; of other lists that they hold objects. Throws base::Error naming the file, the place and the
/// member.
void check_gltf(const std::string& name, const GltfJson& document);

}  // namespace viete::mesh
