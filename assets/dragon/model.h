// From the shape to the finished files.
#pragma once

#include <cstddef>
#include <filesystem>

#include "dragon/mesh.h"

namespace viete::dragon {

inline constexpr std::size_t kVertices = 50000;

/// The dragon: closed, of genus 0, kVertices vertices and 2 kVertices - 4 triangles, standing on y = 0.
/// Takes seconds. Throws std::runtime_error if the shape has a handle or a loose part.
Mesh dragon_mesh();

/// Writes dragon.ply, its shapes, cage.obj, the poses of the cage and loop.viete into a folder that exists.
void write_files(const std::filesystem::path& folder);

}  // namespace viete::dragon
