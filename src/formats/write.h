// Writes a surface to a file; the extension chooses the format.
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

/// OBJ and OFF as text and PLY as binary with positions in double: polygons and vertices read back with the
/// same bits (text uses the shortest exact digits, 17 at most). STL as text: exact triangles, but no polygons
/// and no unused vertices. Comments go to the header, one line each (STL: the first one as its name). Atomic:
/// writes a temporary file, syncs, renames; a failure keeps an existing file. Throws base::Error (for an
/// unknown extension it lists the known ones).
void write(const std::filesystem::path& path, const mesh::Surface& surface,
           const std::vector<std::string>& comments = {});

/// Writes other positions, one per vertex. Uses a fixed amount of memory. progress may be null. Throws
/// base::Cancelled too; an existing file then stays.
void write(const std::filesystem::path& path, const mesh::Surface& surface,
           std::span<const mesh::Point> positions, const std::vector<std::string>& comments = {},
           base::Progress* progress = nullptr);

/// If the original can be written under this name, keeps all content of its file; in another folder it also
/// copies the libraries and images that it names, and removes new ones on failure. Other formats get normals,
/// texture points and colours as supported, but no groups or materials. Returns messages for the user, one
/// line each.
std::vector<std::string> write(const std::filesystem::path& path, const Content& content,
                               const Original* original, Digits digits, base::Progress* progress = nullptr);

/// Writes .glb or .gltf with morph targets and an animation that plays them; the rest model has the positions
/// of the content. An original that can be written keeps its own targets and animations. All targets are in
/// memory until written. Throws base::Error too for an invalid motion, see check_motion(), and for other
/// formats.
std::vector<std::string> write_animated(const std::filesystem::path& path, const Content& content,
                                        const Original* original, const MorphMotion& motion,
                                        base::Progress* progress = nullptr);

/// Throws base::Error if this format does not keep the number and order of vertices: STL and glTF.
void check_keeps_vertices(const std::filesystem::path& path);

}  // namespace viete::formats
