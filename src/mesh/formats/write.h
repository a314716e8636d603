// Writes a surface to a file; the extension chooses the format.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "mesh/formats/morphs.h"
#include "mesh/formats/original.h"
#include "mesh/formats/text_writer.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// OBJ and OFF as text and PLY as binary with positions in double: polygons and vertices as they are, read
/// back with the same bits (text carries the shortest digits, 17 at most, that do so). STL as text: exact
/// triangles, but no polygons and no unused vertices. Comments stand at the head, one line each (STL: the
/// first as its name). Atomic: writes beside the target, syncs, renames; a failure leaves an existing file as
/// it was. Throws base::Error (an unknown extension lists the known ones).
void write(const std::filesystem::path& path, const Surface& surface,
           const std::vector<std::string>& comments = {});

/// The same with other positions for its vertices, one each. Needs no more memory than a fixed portion of the
/// file takes. progress may be null. Throws base::Cancelled too, and then an existing file is as it was.
void write(const std::filesystem::path& path, const Surface& surface, std::span<const Point> positions,
           const std::vector<std::string>& comments = {}, base::Progress* progress = nullptr);

/// The same; where there is an original that can write itself under this name, it does: all that was in the
/// file is in it again, and in another folder the libraries and images that it names come along, of which a
/// failure leaves nothing new. Another format gets normals, texture points and colours as far as it holds
/// them, but no groups and no materials. Returns what a person should know of the result, one line each.
std::vector<std::string> write(const std::filesystem::path& path, const Content& content,
                               const Original* original, Digits digits, base::Progress* progress = nullptr);

/// The same as .glb or .gltf with morph targets and an animation that plays them: at rest the model has the
/// positions of the content. Where the original can write itself, its own targets and animations stay. The
/// bytes of all targets are in memory until they are written. Throws base::Error too for a motion that is
/// none, see check_motion(), and for other formats.
std::vector<std::string> write_animated(const std::filesystem::path& path, const Content& content,
                                        const Original* original, const MorphMotion& motion,
                                        base::Progress* progress = nullptr);

/// Throws base::Error where this name's format would read back other vertices, or in another order, than were
/// written: STL and glTF.
void check_keeps_vertices(const std::filesystem::path& path);

}  // namespace viete::mesh
