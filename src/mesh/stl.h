// STL, text and binary: loose triangles, joined where their corners are equal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/read.h"
#include "mesh/source.h"
#include "mesh/text_writer.h"

namespace viete::mesh {

/// Source: 3D Systems, StereoLithography Interface Specification, 1989. Corners with equal coordinates become
/// one vertex (0 and -0 are equal); vertices stand in the order of their first occurrence. The two
/// attribute bytes of binary files are read as colours of facets, as VisCAM, SolidView and Magics have them.
/// Normals are kept for writing alone. Throws base::Error, base::Cancelled.
ReadResult read_stl(const Source& source);

/// Of a binary STL: what stands before the triangles, and each of these.
inline constexpr std::size_t stl_head_bytes = 84, stl_triangle_bytes = 50;
/// The number that stands there.
double stl_float(const char* bytes);
/// A word of a text STL in small letters, at most 16 of them.
std::string lower_stl_word(std::string_view word);

/// True if the size is exactly what the triangle count of a binary STL asks for, or if the text starts with
/// solid.
bool looks_like_stl(const Source& source);

/// Text, because binary STL would round the positions to float. Keeps triangles only: unused vertices are
/// lost.
void write_stl(const Content& content, TextWriter& out);

}  // namespace viete::mesh
