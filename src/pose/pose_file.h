// Pose files: surface files with the cage's posed vertices. Comment lines at the start contain the turns.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pose/cage.h"

namespace viete::pose {

/// Reads positions in any format of formats::read(), and turns in radians from comment lines
/// `viete turns: part 0: x y z` (the part is an index into cage.roots). Missing turns are 0. Without any
/// turns, Pose::turns is empty. If the file numbers the vertices differently, matches them by the faces, see
/// mesh::vertex_order(). Warns of this, of polygons that are divided differently, of elements without area,
/// and of unreadable turns. Throws base::Error if the file cannot be read or does not match the cage.
Pose read_pose(const std::filesystem::path& path, const Cage& cage, std::vector<std::string>& warnings);

/// Writes the cage's polygons with the pose's positions, and all nonzero turns. Turns have 17 digits, so that
/// no bit is lost. The write is atomic. Throws base::Error if writing fails or the format is .stl.
void write_pose(const std::filesystem::path& path, const Cage& cage, const Pose& pose);

}  // namespace viete::pose
