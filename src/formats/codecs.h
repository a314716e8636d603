// Readers and writers of all surface formats; format.h describes each kind of function.
#pragma once

#include "formats/original.h"
#include "formats/source.h"
#include "formats/text_writer.h"

namespace viete::formats {

/// Every reader throws base::Error and base::Cancelled. If source.owner is set, ReadResult::original is set.
///
/// Source: Wavefront Advanced Visualizer manual, appendix B1. Reads the keywords v (x y z and an optional
/// colour), vt, vn, f, o, g, s, usemtl and mtllib, also in capitals; relative indices; continued lines. Faces
/// may precede their vertices. Invalid indices of texture points and normals, and unreadable material
/// libraries, only cause warnings.
ReadResult read_obj(const Source& source);
/// True if the first non-comment line starts with a keyword unique to OBJ.
bool looks_like_obj(const Source& source);
/// True if at least 90 % of the lines are valid OBJ statements and at least one is a vertex.
bool is_certainly_obj(const Beginning& file);
/// Writes colours, texture points and normals, but no groups or materials. Numbers get the shortest digits
/// that read back exactly, unless the caller requests other digits.
void write_obj(const Content& content, TextWriter& out);

/// Source: Greg Turk, The PLY polygon file format, 1994. Reads x, y, z of element vertex, vertex_indices or
/// vertex_index of element face, tristrips, and the properties listed at PlyBody. The counts in the header
/// are checked against the file size before memory is allocated. Rewriting the file updates x y z, nx ny nz
/// and tx ty tz of vertices and nx ny nz of faces; everything else stays.
ReadResult read_ply(const Source& source);
/// True if the bytes start with the PLY signature.
bool looks_like_ply(const Source& source);
/// True if the file begins with a complete header.
bool is_certainly_ply(const Beginning& file);
/// Writes binary little-endian PLY: positions in double; normals if each vertex has only one; colours;
/// texture points per vertex, or per face if a vertex has several.
void write_ply(const Content& content, TextWriter& out);

/// Source: Geomview manual, "OFF Files". Reads OFF and its variants with colours, normals or texture
/// coordinates after the positions, in any order; comments; files without the keyword OFF; colours that the
/// keyword does not declare. The indices of a face may continue on the next line. Not supported: 4OFF, nOFF,
/// BINARY.
ReadResult read_off(const Source& source);
/// True if the first word is OFF or a variant such as COFF.
bool looks_like_off(const Source& source);
/// True if the optional keyword is followed only by numbers, and by enough numbers for the declared counts.
bool is_certainly_off(const Beginning& file);
void write_off(const Content& content, TextWriter& out);

/// Source: 3D Systems, StereoLithography Interface Specification, 1989. Corners with equal coordinates become
/// one vertex (0 and -0 are equal). Vertices are in the order of their first corner. Rewriting the file keeps
/// the attributes of triangles and updates the normals of moved triangles, except 0 0 0.
ReadResult read_stl(const Source& source);
/// True if the size matches the triangle count of a binary STL exactly, or if the text starts with "solid".
bool looks_like_stl(const Source& source);
/// True if each line of a text starts with an STL keyword, or if the first triangles of a binary file are
/// plausible.
bool is_certainly_stl(const Beginning& file);
/// Writes triangles as text, because binary STL rounds positions to float. Vertices without a triangle are
/// left out.
void write_stl(const Content& content, TextWriter& out);

/// Source: The Khronos Group, glTF 2.0 Specification, 2021. Reads all meshes of the default scene, placed by
/// their nodes. Morph targets have their default weights; skins and animations are not applied. Coincident
/// vertices of a node are merged even if their normals or texture points differ. Points and lines become
/// vertices without polygons. External buffers must be in the folder of source.name or below. There may be
/// at most 4 million more vertices and corners than bytes in all buffers.
ReadResult read_gltf(const Source& source);
/// True for a GLB, or JSON with an asset.
bool looks_like_gltf(const Source& source);
/// True for a GLB of version 2, or JSON whose asset has version 2.
bool is_certainly_gltf(const Beginning& file);
/// Writes one node with one mesh and one primitive: positions in float, texture points, normals, colours.
/// Surfaces without normals get computed normals; is_flat() surfaces get none, which glTF shows flat-shaded.
/// Polygons become triangles. Throws base::Error beyond 4 GB, the limit of GLB.
void write_glb(const Content& content, TextWriter& out);
/// Writes JSON with embedded buffers; otherwise as write_glb().
void write_gltf(const Content& content, TextWriter& out);
/// Writes GLB or glTF with an animation of the vertices, see check_motion(). progress may be null. Throws
/// base::Cancelled too.
void write_gltf_animated(const Content& content, const MorphMotion& motion, bool binary, TextWriter& out,
                         base::Progress* progress);

}  // namespace viete::formats
