// Writes a surface to a file in the format of its extension.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "formats/morphs.h"
#include "formats/original.h"
#include "formats/text_writer.h"
#include "mesh/surface.h"

namespace viete::formats {

/// OBJ, OFF (text) and PLY (binary) store exact polygons and vertices. STL (text) stores exact triangles, but
/// no larger polygons and no unused vertices. glTF: see write_glb(). Comments go to the header, one line
/// each; in STL the first comment is the name. Writes a temporary file, syncs and renames it, so that a
/// failure keeps an existing file. Throws base::Error.
void write(const std::filesystem::path& path, const mesh::Surface& surface,
           const std::vector<std::string>& comments = {});

/// Writes these positions, one per vertex, instead of surface.positions. progress may be null. Throws
/// base::Cancelled too and then keeps an existing file.
void write(const std::filesystem::path& path, const mesh::Surface& surface,
           std::span<const mesh::Point> positions, const std::vector<std::string>& comments = {},
           base::Progress* progress = nullptr);

/// If writes_itself(original, path), rewrites the original: all content is kept, and material libraries and
/// images are copied to a new folder (and removed again on failure). Otherwise writes the normals, texture
/// points and colours that the format supports, but no groups or materials. Returns messages for the user,
/// one line each.
std::vector<std::string> write(const std::filesystem::path& path, const Content& content,
                               const Original* original, Digits digits, base::Progress* progress = nullptr);

/// Writes .glb or .gltf with morph targets and an animation. The rest model has the positions of the content.
/// If writes_itself(original, path), the targets and animations of the original are kept. All targets are in
/// memory at once. Throws base::Error too for an invalid motion, see check_motion(), and for other formats.
std::vector<std::string> write_animated(const std::filesystem::path& path, const Content& content,
                                        const Original* original, const MorphMotion& motion,
                                        base::Progress* progress = nullptr);

/// Throws base::Error for STL and glTF, which do not keep the number and order of vertices.
void check_keeps_vertices(const std::filesystem::path& path);

}  // namespace viete::formats
