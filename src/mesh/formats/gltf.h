// glTF 2.0: text with its buffers, and GLB.
#pragma once

#include "mesh/formats/original.h"
#include "mesh/formats/source.h"
#include "mesh/formats/text_writer.h"

namespace viete::mesh {

/// Source: The Khronos Group, glTF 2.0 Specification, 2021. All meshes of the default scene where their nodes
/// put them, at rest: morph targets have their default weights, bones and animations are not played. Vertices
/// of a node that lie at the same place are one vertex of the surface, though their normals or texture points
/// differ. Points and lines give vertices that follow, and no polygons. Buffers beside are read within the
/// folder of source.name alone. Nodes that place a mesh many times may make 4 million vertices more than the
/// file has bytes. Throws base::Error, base::Cancelled.
ReadResult read_gltf(const Source& source);

/// True if it is a GLB or JSON with an asset.
bool looks_like_gltf(const Source& source);

/// True if it is a GLB of version 2, or JSON whose asset has such a version.
bool is_certainly_gltf(const Beginning& file);

}  // namespace viete::mesh
