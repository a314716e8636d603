// Writes GLB and glTF: the container, and a file made of any surface.
#pragma once

#include <string_view>

#include "base/progress.h"
#include "mesh/formats/morphs.h"
#include "mesh/formats/text_writer.h"

namespace viete::mesh {

/// One node with a mesh of one primitive, positions in float; texture points, normals, colours. A surface
/// without normals gets computed ones, one that is_flat() none, which is how glTF says so. Polygons become
/// triangles. Throws base::Error past 4 GB, which GLB cannot hold.
void write_glb(const Content& content, TextWriter& out);

/// The same as text with all bytes in it.
void write_gltf(const Content& content, TextWriter& out);

/// Either of these with an animation of the content's vertices, see check_motion(). Tells progress (which
/// may be null) of its targets. Throws base::Cancelled too.
void write_gltf_animated(const Content& content, const MorphMotion& motion, bool binary, TextWriter& out,
                         base::Progress* progress);

/// The JSON, the bytes of its first buffer (there may be none), and further chunks with their heads. Throws
/// base::Error past 4 GB.
void write_glb_chunks(std::string_view json, std::string_view bytes, std::string_view others,
                      TextWriter& out);

}  // namespace viete::mesh
