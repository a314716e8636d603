// Stanford PLY, ascii and binary of either byte order.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesh/formats/original.h"
#include "mesh/formats/ply_file.h"
#include "mesh/formats/source.h"
#include "mesh/formats/text_writer.h"

namespace viete::mesh {

/// Source: Greg Turk, The PLY polygon file format, 1994. Read: x, y, z of element vertex, vertex_indices or
/// vertex_index of element face, tristrips; of vertices what PlyAttributes knows. All else is kept for
/// writing alone. The counts of the header are compared with the bytes there are before any memory is taken.
/// Throws base::Error, base::Cancelled.
ReadResult read_ply(const Source& source);

/// True if the bytes start as every PLY file must.
bool looks_like_ply(const Source& source);

/// True if a whole header begins the file.
bool is_certainly_ply(const Beginning& file);

/// Binary, little-endian, positions in double; normals, colours and texture points where there is one a
/// vertex.
void write_ply(const Content& content, TextWriter& out);

/// The file as it was, to be written again. Header, elements and properties stay in type and order. Of the
/// first vertex element x y z, nx ny nz and tx ty tz follow, of faces nx ny nz, rounded to the type that the
/// file gives them; in text with as many decimals as the file has, and no fewer than six digits of the
/// model's diagonal need. It throws base::Error too where a position does not fit into its type. body: where
/// the first element begins. companions: the images that its comments name.
std::shared_ptr<const Original> ply_original(const Source& source, PlyHeader header, std::size_t body,
                                             Companions companions);

}  // namespace viete::mesh
