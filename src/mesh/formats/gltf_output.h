// Writes GLB and glTF: the container, and any surface as a new file.
#pragma once

#include <string_view>

#include "base/progress.h"
#include "mesh/formats/morphs.h"
#include "mesh/formats/text_writer.h"

namespace viete::mesh {

/// Writes one node with one mesh of one primitive: positions in float, texture points, normals, colours.
/// Surfaces without normals get computed ones; is_flat() surfaces get none, which means flat shading in glTF.
/// Polygons become triangles. Throws base::Error beyond 4 GB, the limit of GLB.
void write_glb(const Content& content, TextWriter& out);

/// The same as JSON with embedded buffers.
void write_gltf(const Content& content, TextWriter& out);

/// GLB or glTF with an animation of the content's vertices, see check_motion(). progress (may be null) counts
/// targets. Throws base::Cancelled too.
void write_gltf_animated(const Content& content, const MorphMotion& motion, bool binary, TextWriter& out,
                         base::Progress* progress);

/// Writes the JSON chunk, the binary chunk (may be empty) and further chunks including headers. Throws
/// base::Error beyond 4 GB.
void write_glb_chunks(std::string_view json, std::string_view bytes, std::string_view others,
                      TextWriter& out);

}  // namespace viete::mesh
