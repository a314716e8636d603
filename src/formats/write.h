// Writes a surface to a file. The file extension chooses the format.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.h"
#include "formats/original.h"
#include "formats/text_writer.h"
#include "mesh/surface.h"

namespace viete::formats {

/// The content of a capture that formats without splats do not store.
inline constexpr std::string_view splat_content = "sizes, rotations, opacities and colours of splats";

/// Writes a surface. OBJ, OFF (text) and PLY (binary) keep polygons and vertices exactly. STL (text) keeps
/// triangles exactly, but no larger polygons and no unused vertices. For glTF see write_glb(). Comments go to
/// the header, one line each; in STL the first comment is the name. Writes a temporary file, syncs the file
/// and renames it. If an error occurs, an existing file stays. Throws base::Error.
void write(const std::filesystem::path& path, const mesh::Surface& surface,
           const std::vector<std::string>& comments = {});

/// If writes_itself(original, path), rewrites the original with all content, and copies its material
/// libraries and images to the folder of `path`. If writing fails, deletes these copies. If writes_itself()
/// is false, writes the normals, texture points and colours that the format supports, but no groups or
/// materials. Returns messages for the user, one line each. `progress` may be null. If cancelled, throws
/// base::Cancelled, and an existing file stays. Refuses a capture with moved vertices but without posed
/// splats.
std::vector<std::string> write(const std::filesystem::path& path, const Content& content,
                               const Original* original, Digits digits, base::Progress* progress = nullptr);

/// Writes .glb or .gltf with morph targets and an animation. At rest, the model has content.positions.
/// If writes_itself(original, path), keeps the targets and animations of the original. All targets are in
/// memory at once. Also throws base::Error for other formats, for captures, and for a motion that
/// check_motion() rejects.
std::vector<std::string> write_animated(const std::filesystem::path& path, const Content& content,
                                        const Original* original, const MorphMotion& motion,
                                        base::Progress* progress = nullptr);

/// If `original` is a capture whose splats are not read, throws base::Error. `file` is named in the error;
/// `original` may be null.
void check_deformable(const std::filesystem::path& file, const Original* original);

/// Throws base::Error for the formats that change the number and order of vertices: STL and glTF.
void check_keeps_vertices(const std::filesystem::path& path);

}  // namespace viete::formats
