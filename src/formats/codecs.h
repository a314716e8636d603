// Readers and writers of surfaces, for the rows of format_table.h; see Format for each kind of function.
#pragma once

#include "formats/original.h"
#include "formats/source.h"
#include "formats/text_writer.h"

namespace viete::formats {

/// Source: Wavefront Advanced Visualizer manual, appendix B1. Reads v (x y z, optional colour), vt, vn, f
/// with v, v/vt, v//vn, v/vt/vn, relative indices, continued lines; o, g, s, usemtl and mtllib; also in
/// capitals. Faces may precede their vertices. Invalid texture and normal indices and unreadable libraries
/// are warnings. All readers: with source.owner the result can be written again; throw base::Error and
/// base::Cancelled.
ReadResult read_obj(const Source& source);
/// True if the first non-comment line starts with a keyword unique to OBJ.
bool looks_like_obj(const Source& source);
/// True if nine of ten lines are OBJ statements with the numbers they need, and one is a vertex.
bool is_certainly_obj(const Beginning& file);
/// Writes the shortest digits that read back exactly, unless other digits are requested. Writes colours,
/// texture points and normals, but no groups or materials.
void write_obj(const Content& content, TextWriter& out);

/// Source: Greg Turk, The PLY polygon file format, 1994. Reads x, y, z of element vertex, vertex_indices or
/// vertex_index of element face, tristrips, and the properties listed at PlyBody. Everything else is only
/// kept for writing, which updates x y z, nx ny nz and tx ty tz of vertices and nx ny nz of faces. Header
/// counts are checked against the file size before memory is allocated.
ReadResult read_ply(const Source& source);
/// True if the bytes start with the PLY signature.
bool looks_like_ply(const Source& source);
/// True if the file begins with a complete header.
bool is_certainly_ply(const Beginning& file);
/// Writes binary, little-endian, positions in double; normals, colours and texture points if there is one per
/// vertex.
void write_ply(const Content& content, TextWriter& out);

/// Source: Geomview manual, "OFF Files". Reads OFF and its variants with colours, normals or texture
/// coordinates after positions, in any order; comments; files without the keyword OFF; undeclared colours.
/// The indices of a face may continue on the next line. Not supported: 4OFF, nOFF, BINARY.
ReadResult read_off(const Source& source);
/// True if the first word is OFF or a variant.
bool looks_like_off(const Source& source);
/// True if only numbers follow, and enough of them for the declared counts.
bool is_certainly_off(const Beginning& file);
void write_off(const Content& content, TextWriter& out);

/// Source: 3D Systems, StereoLithography Interface Specification, 1989. Corners with equal coordinates become
/// one vertex (0 and -0 are equal), in order of first occurrence. Attributes and normals are only kept for
/// writing; normals of moved facets are updated, except 0 0 0.
ReadResult read_stl(const Source& source);
/// True if the size matches the triangle count of a binary STL exactly, or if the text starts with "solid".
bool looks_like_stl(const Source& source);
/// True if the words of a text are STL keywords, or if the first triangles of a binary file are plausible.
bool is_certainly_stl(const Beginning& file);
/// Writes text, because binary STL rounds positions to float. Writes triangles only: drops unused vertices.
void write_stl(const Content& content, TextWriter& out);

/// Source: The Khronos Group, glTF 2.0 Specification, 2021. Reads all meshes of the default scene, placed by
/// their nodes, at rest: morph targets have default weights; skins and animations are not applied. Coincident
/// vertices of a node are merged even if their normals or texture points differ. Points and lines give
/// trailing vertices without polygons. External buffers must lie within the folder of source.name. Instancing
/// may add at most 4 million vertices beyond the file's size in bytes.
ReadResult read_gltf(const Source& source);
/// True for a GLB, or JSON with an asset.
bool looks_like_gltf(const Source& source);
/// True for a GLB of version 2, or JSON whose asset has that version.
bool is_certainly_gltf(const Beginning& file);
/// Writes one node with one mesh of one primitive: positions in float, texture points, normals, colours.
/// Surfaces without normals get computed ones; is_flat() surfaces get none, which means flat shading in glTF.
/// Polygons become triangles. Throws base::Error beyond 4 GB, the limit of GLB.
void write_glb(const Content& content, TextWriter& out);
/// The same as JSON with embedded buffers.
void write_gltf(const Content& content, TextWriter& out);
/// GLB or glTF with an animation of the content's vertices, see check_motion(). progress (may be null) counts
/// targets. Throws base::Cancelled too.
void write_gltf_animated(const Content& content, const MorphMotion& motion, bool binary, TextWriter& out,
                         base::Progress* progress);

}  // namespace viete::formats
