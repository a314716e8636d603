// STL, text and binary: loose triangles, joined where their corners are equal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/formats/read_result.h"
#include "mesh/formats/source.h"
#include "mesh/formats/stl_layout.h"
#include "mesh/formats/text_writer.h"

namespace viete::mesh {

/// Source: 3D Systems, StereoLithography Interface Specification, 1989. Corners with equal coordinates become
/// one vertex (0 and -0 are equal); vertices stand in the order of their first occurrence. The two
/// attribute bytes of binary files are read as colours of facets, as VisCAM, SolidView and Magics have them;
/// where the file is as long as it must be if they count attributes that follow, those are passed over.
/// Normals are kept for writing alone. Throws base::Error, base::Cancelled.
ReadResult read_stl(const Source& source);

/// True if the size is exactly what the triangle count of a binary STL asks for, or if the text starts with
/// solid.
bool looks_like_stl(const Source& source);

/// True if the words of a text are those of STL, or if the numbers of the first triangles of a binary file
/// make sense.
bool is_certainly_stl(const Beginning& file);

/// Text, because binary STL would round the positions to float. Keeps triangles only: unused vertices are
/// lost.
void write_stl(const Content& content, TextWriter& out);

}  // namespace viete::mesh
