// A cage with a hole.
#pragma once

#include <filesystem>
#include <vector>

#include "formats/read.h"
#include "formats/write.h"
#include "program/driver.h"

namespace viete::test {

/// Writes the dragon's cage without its first face, and returns the file.
inline std::filesystem::path open_cage(const std::filesystem::path& folder) {
  const mesh::Surface surface = formats::read(dragon_cage).surface;
  const std::vector<mesh::Triangle> triangles(surface.triangles.begin() + 1, surface.triangles.end());
  const std::filesystem::path path = folder / "open.obj";
  formats::write(path, mesh::from_triangles(surface.positions, triangles));
  return path;
}

}  // namespace viete::test
