// Wavefront OBJ, text: vertices and polygons, texture coordinates, normals, colours, groups and materials.
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

/// Source: Wavefront Advanced Visualizer manual, appendix B1. Read: v (x y z, and a colour behind them), vt,
/// vn, f with v, v/vt, v//vn, v/vt/vn, relative indices, continued lines; o, g, s, usemtl and mtllib; also in
/// capitals. A face may stand before its vertices. Texture and normal indices that lead nowhere, and
/// libraries that cannot be read, are warnings. With source.owner the result can be written again. Throws
/// base::Error, base::Cancelled.
ReadResult read_obj(const Source& source);

/// True if the first line that holds more than a comment starts with a word that only OBJ files use.
bool looks_like_obj(const Source& source);

/// True if nine of ten lines are statements of OBJ with the numbers that they need, and one is a vertex.
bool is_certainly_obj(const Beginning& file);

/// The shortest digits that read back as the same numbers, unless other digits are asked for. Colours,
/// texture points and normals; no groups and no materials.
void write_obj(const Content& content, TextWriter& out);

/// The file as it was, to be written again. Coordinates that moved are printed with as many decimals as the
/// file has, and no fewer than six digits of the model's diagonal need. Normals follow; a line that serves
/// corners whose normals now differ gets others behind its block, and indices of faces are changed
/// accordingly. attributes may be null. normal_blocks: of each block of lines `vn` the number of such lines
/// up to its end, ascending; the last is that of the file. libraries: behind `mtllib`, see read_materials().
std::shared_ptr<const Original> obj_original(const Source& source,
                                             std::shared_ptr<const Attributes> attributes,
                                             std::vector<std::uint32_t> normal_blocks,
                                             std::vector<std::string> libraries);

}  // namespace viete::mesh
