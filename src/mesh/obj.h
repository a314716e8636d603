// Wavefront OBJ, text: vertices and polygons; everything else in the file is passed over.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesh/read.h"
#include "mesh/source.h"
#include "mesh/text_writer.h"

namespace viete::mesh {

/// Source: Wavefront Advanced Visualizer manual, appendix B1. Read: v (x y z; a weight or a colour behind
/// them is passed over), f with v, v/vt, v//vn, v/vt/vn, relative indices, continued lines; also in capitals.
/// A face may stand before its vertices. Texture and normal indices are not looked at. Throws base::Error,
/// base::Cancelled.
ReadResult read_obj(const Source& source);

/// True if the first line that holds more than a comment starts with a word that only OBJ files use.
bool looks_like_obj(const Source& source);

void write_obj(const Content& content, TextWriter& out);

}  // namespace viete::mesh
