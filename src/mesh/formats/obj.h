// Wavefront OBJ: vertices, polygons, texture coordinates, normals, colours, groups and materials.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/formats/original.h"
#include "mesh/formats/source.h"
#include "mesh/formats/text_writer.h"

namespace viete::mesh {

/// Source: Wavefront Advanced Visualizer manual, appendix B1. Reads v (x y z, optional colour), vt, vn, f
/// with v, v/vt, v//vn, v/vt/vn, relative indices, continued lines; o, g, s, usemtl and mtllib; also in
/// capitals. Faces may precede their vertices. Invalid texture and normal indices and unreadable libraries
/// are warnings. With source.owner the result can be written again. Throws base::Error, base::Cancelled.
ReadResult read_obj(const Source& source);

/// True if the first non-comment line starts with a keyword unique to OBJ.
bool looks_like_obj(const Source& source);

/// True if nine of ten lines are OBJ statements with the numbers they need, and one is a vertex.
bool is_certainly_obj(const Beginning& file);

/// Writes the shortest digits that read back exactly, unless other digits are requested. Writes colours,
/// texture points and normals, but no groups or materials.
void write_obj(const Content& content, TextWriter& out);

/// The file kept as read, to be written again. Moved coordinates get as many decimals as in the file, and at
/// least six significant digits of the model's diagonal. Normals are updated; a normal line whose corners now
/// differ gets additional lines after its block, and face indices are renumbered. attributes may be null.
/// normal_blocks: for each block of `vn` lines the number of such lines up to its end, ascending; the last is
/// the total. libraries: texts after `mtllib`, see read_materials().
std::shared_ptr<const Original> obj_original(const Source& source,
                                             std::shared_ptr<const Attributes> attributes,
                                             std::vector<std::uint32_t> normal_blocks,
                                             std::vector<std::string> libraries);

}  // namespace viete::mesh
