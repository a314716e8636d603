// STL, text and binary: separate triangles, joined at equal corners.
#pragma once

#include "mesh/formats/original.h"
#include "mesh/formats/source.h"
#include "mesh/formats/text_writer.h"

namespace viete::mesh {

/// Source: 3D Systems, StereoLithography Interface Specification, 1989. Corners with equal coordinates become
/// one vertex (0 and -0 are equal), in order of first occurrence. Normals and attribute bytes are only kept
/// for writing; normals of moved facets are updated, except 0 0 0. Throws base::Error, base::Cancelled.
ReadResult read_stl(const Source& source);

/// True if the size matches the triangle count of a binary STL exactly, or if the text starts with "solid".
bool looks_like_stl(const Source& source);

/// True if the words of a text are STL keywords, or if the first triangles of a binary file are plausible.
bool is_certainly_stl(const Beginning& file);

/// Writes text, because binary STL rounds positions to float. Writes triangles only: drops unused vertices.
void write_stl(const Content& content, TextWriter& out);

}  // namespace viete::mesh
