// Poses as files: a surface file with the cage's vertices moved, and the turns in comment lines at its head.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "deform/cage.h"

namespace viete::deform {

/// Positions from any format of mesh::read, turns from comment lines `viete turns: part 0: x y z` (radians,
/// part = index into cage.roots; missing: 0). Warnings, one line each: faces that differ from the cage's,
/// elements without area, unreadable turns. Throws base::Error if the file cannot be read, if its vertex
/// count differs from the cage's, or if it is an STL file (which has no vertex order) with different faces.
Pose read_pose(const std::filesystem::path& path, const Cage& cage, std::vector<std::string>& warnings);

/// Writes the cage's polygons with the pose's positions; nonzero turns with 17 digits, so that they are read
/// back exactly. Atomic; throws base::Error, also for .stl.
void write_pose(const std::filesystem::path& path, const Cage& cage, const Pose& pose);

}  // namespace viete::deform
