// A cage with a hole, which gives findings.
#pragma once

#include <filesystem>
#include <vector>

#include "mesh/formats/read.h"
#include "mesh/formats/write.h"
#include "program/driver.h"

namespace viete::test {

/// The dragon's cage without its first face.
inline std::filesystem::path open_cage(const std::filesystem::path& folder) {
  const mesh::Surface surface = mesh::read(dragon_cage).surface;
  const std::vector<mesh::Triangle> triangles(surface.triangles.begin() + 1, surface.triangles.end());
  const std::filesystem::path path = folder / "open.obj";
  mesh::write(path, mesh::from_triangles(surface.positions, triangles));
  return path;
}

}  // namespace viete::test
