// Poses as files: a surface file with the cage's vertices moved, and the turns in comment lines at its head.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "deform/cage.h"

namespace viete::deform {

/// Positions from any format of mesh::read, turns from comment lines `viete turns: part 0: x y z` (radians,
/// part = index into cage.roots; missing: 0). Warnings, one line each: other faces than the cage's, elements
/// without area, turns that cannot be read. Throws base::Error if the file cannot be read, has another
/// number of vertices than the cage, or is an STL file, which keeps no order of vertices, with other faces
/// than the cage's.
Pose read_pose(const std::filesystem::path& path, const Cage& cage, std::vector<std::string>& warnings);

/// The cage's polygons with the pose's positions; turns that are not 0 with 17 digits, so that they come back
/// exactly. Atomic; throws base::Error, also for .stl.
void write_pose(const std::filesystem::path& path, const Cage& cage, const Pose& pose);

}  // namespace viete::deform
