// Reads glTF 2.0: JSON with buffers (.gltf) and binary (.glb).
#pragma once

#include "mesh/formats/original.h"
#include "mesh/formats/source.h"
#include "mesh/formats/text_writer.h"

namespace viete::mesh {

/// Source: The Khronos Group, glTF 2.0 Specification, 2021. Reads all meshes of the default scene, placed by
/// their nodes, at rest: morph targets have default weights; skins and animations are not applied. Coincident
/// vertices of a node are merged even if their normals or texture points differ. Points and lines give
/// trailing vertices without polygons. External buffers must lie within the folder of source.name. Instancing
/// may add at most 4 million vertices beyond the file's size in bytes. Throws base::Error, base::Cancelled.
ReadResult read_gltf(const Source& source);

/// True for a GLB, or JSON with an asset.
bool looks_like_gltf(const Source& source);

/// True for a GLB of version 2, or JSON whose asset has that version.
bool is_certainly_gltf(const Beginning& file);

}  // namespace viete::mesh
