// Readers and writers of all surface formats; format_table.h describes each kind of function.
#pragma once

#include "formats/original.h"
#include "formats/source.h"
#include "formats/text_writer.h"

namespace viete::formats {

/// The end of a reader's warning about a capture whose splats are not read; see Capture::points.
inline constexpr const char* capture_note =
    "this is a capture (Gaussian splats) of a kind that is only shown as points and cannot be deformed; "
    "convert it to .ply or .spz with complete splats";

// Readers can throw base::Error and base::Cancelled. If source.owner is set, they set ReadResult::original.

/// Specification: Wavefront Advanced Visualizer manual, appendix B1. Reads the keywords v (x y z and an
/// optional colour), vt, vn, f, o, g, s, usemtl and mtllib, also in capitals. Supports relative indices,
/// continued lines, and faces before their vertices. Invalid indices of texture points or normals and
/// unreadable material libraries only cause warnings.
ReadResult read_obj(const Source& source);
/// Returns true if the first line with content starts with an OBJ keyword in lower case.
bool looks_like_obj(const Source& source);
/// Returns true if at least 90 % of the lines are valid OBJ statements and the file has a vertex.
bool is_certainly_obj(const Beginning& file);
/// Writes colours, texture points, normals, groups and the names of materials, which must be different. By
/// default, positions have the shortest digits from which the exact number can be read.
void write_obj(const Content& content, TextWriter& out);
/// Writes a material library. In addition to the manual's statements, uses Pr, Pm, map_Pr, map_Pm, map_Ke and
/// norm of the PBR extension (Clara.io, 2014), and map_Bump for normal maps like Blender. ImageFile::name is
/// the path in the file.
void write_mtl(const Attributes& attributes, TextWriter& out);

/// Specification: Greg Turk, The PLY polygon file format, 1994. Reads positions, faces, triangle strips, and
/// the properties listed at PlyBody in ply.cpp. Compares the counts in the header with the file size before
/// it allocates memory. Rewriting the file updates x y z, nx ny nz and tx ty tz of vertices, and nx ny nz of
/// faces. All other content stays. A capture has the vertex properties of B. Kerbl et al., 3D Gaussian
/// Splatting for Real-Time Radiance Field Rendering, 2023: all of scale_0 to 2, rot_0 to 3 and opacity. They
/// become splats. Missing f_dc_* are 0, and incomplete bands of f_rest_* are not read; warnings name both.
/// Rewriting updates x y z and the splats. Normals of captures mean nothing and are ignored. Refuses
/// compressed captures.
ReadResult read_ply(const Source& source);
/// Returns true if the bytes start with the PLY signature.
bool looks_like_ply(const Source& source);
/// Returns true if the file begins with a complete header.
bool is_certainly_ply(const Beginning& file);
/// Writes binary little-endian PLY with double positions, normals, colours and texture points. If any vertex
/// has several normals, writes no normals. Splats without polygons are written with the float properties that
/// programs for captures expect, in their order: x y z nx ny nz f_dc_* f_rest_* opacity scale_* rot_*.
void write_ply(const Content& content, TextWriter& out);

/// Specification: Geomview manual, "OFF Files". Reads OFF and the variants with colours, normals or texture
/// coordinates after the positions. The keyword OFF may be missing, and colours need not be declared. A face
/// may continue on the next line. Not supported: 4OFF, nOFF, BINARY.
ReadResult read_off(const Source& source);
/// Returns true if the first word is OFF or a variant such as COFF.
bool looks_like_off(const Source& source);
/// Returns true if all words after the optional keyword are numbers. A complete
/// file must also have enough numbers.
bool is_certainly_off(const Beginning& file);
void write_off(const Content& content, TextWriter& out);

/// Specification: 3D Systems, StereoLithography Interface Specification, 1989. Corners with equal coordinates
/// become one vertex (0 and -0 are equal). Vertices are in the order of their first corner. Rewriting the
/// file keeps the attributes of triangles, and updates the normals of moved triangles. Normals 0 0 0 stay.
ReadResult read_stl(const Source& source);
/// Returns true if the size matches the triangle count of a binary STL, or the text starts with "solid".
bool looks_like_stl(const Source& source);
/// Returns true if all lines start with STL keywords, or the first triangles of a binary file are plausible.
bool is_certainly_stl(const Beginning& file);
/// Writes triangles as text, because binary STL rounds positions to float. Does not write unused vertices.
void write_stl(const Content& content, TextWriter& out);

/// Specification: The Khronos Group, glTF 2.0 Specification, 2021. Reads all meshes of the default scene,
/// with the transforms of their nodes. Morph targets have their default weights, unless source.played is
/// true. Skins and animations are not applied. Coincident vertices of a node become one vertex, even if their
/// normals or texture points differ. Points and lines become vertices without polygons. External buffers must
/// be in the folder of the file or below. The limit is: vertices + corners <= bytes of buffers + 4 million.
ReadResult read_gltf(const Source& source);
/// Returns true for a GLB file, or for JSON that contains the key "asset".
bool looks_like_gltf(const Source& source);
/// Returns true for a GLB file of version 2, or for JSON with an asset of version 2.
bool is_certainly_gltf(const Beginning& file);
/// Writes a node with a mesh for each run of polygons of an object, and a primitive for each of its
/// materials: float positions, texture points, normals, colours. Images must have bytes; see embed_images().
/// Far from the origin, positions are relative to the nodes' translation. Computes missing normals. A surface
/// that is_flat() and has no normals stays without normals, because viewers then use flat shading. Polygons
/// become triangles. If the GLB exceeds 4 GB, throws base::Error.
void write_glb(const Content& content, TextWriter& out);
/// Works like write_glb(), but writes JSON with embedded buffers.
void write_gltf(const Content& content, TextWriter& out);
/// If `binary`, works like write_glb(), otherwise like write_gltf(). Adds an animation. `motion` must pass
/// check_motion() or have no targets. `progress` may be null. Can also throw base::Cancelled.
void write_gltf_animated(const Content& content, const MorphMotion& motion, bool binary, TextWriter& out,
                         base::Progress* progress);

/// Specification: Niantic Labs, https://github.com/nianticlabs/spz, README, 2025. Reads versions 2 and 3,
/// which are compressed with gzip. The axes of SPZ are right, up, back. Positions, rotations and harmonics
/// are converted to the axes of PLY captures: right, down, forward. Opacities 0 and 1 become 0.001 and 0.999,
/// so that logits are finite. Harmonics of the fourth degree are not read. Compares the number of splats with
/// the file size before it allocates memory. Rewriting the file keeps the bytes of unchanged splats.
ReadResult read_spz(const Source& source);
/// Returns true for gzip content that begins with the signature of SPZ.
bool looks_like_spz(const Source& source);
bool is_certainly_spz(const Beginning& file);
/// Writes version 3 with the most precise positions that fit in 24 bits. content.splats must not be null.
void write_spz(const Content& content, TextWriter& out);

}  // namespace viete::formats
