// What a glTF file holds that no surface with attributes does.
#pragma once

#include <string>
#include <vector>

#include "mesh/formats/gltf_file.h"

namespace viete::mesh {

/// "animations", "morph targets" ...: who converts the file says that they are left out.
std::vector<std::string> beyond_attributes(const GltfFile& file);

}  // namespace viete::mesh
