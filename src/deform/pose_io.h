// Pose files: surface files with the cage's vertices moved, and the turns in comment lines at the start.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "deform/cage.h"

namespace viete::deform {

/// Reads positions from any format of formats::read(), turns from comment lines `viete turns: part 0: x y z`
/// in radians. `part` is an index into cage.roots; missing turns are 0. Adds one line to warnings for faces
/// that differ from the cage's, elements without area, and unreadable turns. Throws base::Error if the file
/// cannot be read, has another vertex count, or is an STL file (without vertex order) with other faces.
Pose read_pose(const std::filesystem::path& path, const Cage& cage, std::vector<std::string>& warnings);

/// Writes the cage's polygons with the pose's positions. Turns that are not 0 get 17 digits, so that they
/// are read back exactly. Atomic. Throws base::Error on failure and for .stl.
void write_pose(const std::filesystem::path& path, const Cage& cage, const Pose& pose);

}  // namespace viete::deform
