// Writes the model and its cages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "dragon/mesh.h"

namespace viete::dragon {

/// Binary little-endian PLY: float32 positions, uchar/int32 face lists.
void write_ply(const std::filesystem::path& path, const Mesh& mesh, const std::string& comment);

/// A point cache of one frame: float32 positions.
void write_pc2(const std::filesystem::path& path, const std::vector<Vec3>& positions);

/// OBJ with four decimals, comment in the first line.
void write_obj(const std::filesystem::path& path, const Mesh& mesh, const std::string& comment);

void append_little_endian(std::string& bytes, std::uint32_t word);

/// Writes beside the target and renames, so that no reader sees half a file.
void write_whole(const std::filesystem::path& path, const std::string& bytes);

}  // namespace viete::dragon
