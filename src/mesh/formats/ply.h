// Stanford PLY, ASCII and binary in either byte order.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesh/formats/original.h"
#include "mesh/formats/ply_file.h"
#include "mesh/formats/source.h"
#include "mesh/formats/text_writer.h"

namespace viete::mesh {

/// Source: Greg Turk, The PLY polygon file format, 1994. Reads x, y, z of element vertex, vertex_indices or
/// vertex_index of element face, tristrips, and the vertex properties of PlyAttributes. Everything else is
/// only kept for writing. Header counts are checked against the file size before memory is allocated. Throws
/// base::Error, base::Cancelled.
ReadResult read_ply(const Source& source);

/// True if the bytes start with the PLY signature.
bool looks_like_ply(const Source& source);

/// True if the file begins with a complete header.
bool is_certainly_ply(const Beginning& file);

/// Writes binary, little-endian, positions in double; normals, colours and texture points if there is one per
/// vertex.
void write_ply(const Content& content, TextWriter& out);

/// The file kept as read, to be written again. Header, elements and properties keep type and order. Updates x
/// y z, nx ny nz and tx ty tz of the first vertex element and nx ny nz of faces, rounded to their type in the
/// file; text gets as many decimals as in the file, and at least six significant digits of the model's
/// diagonal. Writing throws base::Error also if a position exceeds its type. body: offset of the first
/// element. companions: the images named in comments.
std::shared_ptr<const Original> ply_original(const Source& source, PlyHeader header, std::size_t body,
                                             Companions companions);

}  // namespace viete::mesh
