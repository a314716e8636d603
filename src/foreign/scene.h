// A scene as it travels from viete-import to the program that reads a file, and its bytes.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "formats/attributes.h"
#include "mesh/surface.h"

namespace viete::foreign {

/// Positions of all vertices at full weight of a morph target.
struct Target {
  std::string name;
  std::vector<mesh::Point> positions;
};

struct Scene {
  std::string failure;  ///< the reason why the file cannot be read; empty: the file was read
  std::vector<mesh::Point> positions;
  std::vector<std::uint32_t> corners;         ///< see Surface
  std::vector<std::uint32_t> polygon_starts;  ///< see Surface
  formats::Attributes attributes;
  std::vector<Target> targets;
  std::vector<std::string> notes;    ///< messages for the user
  std::vector<std::string> ignored;  ///< content that is not read: "animations"
};

/// Thrown by scene_of().
struct DamagedScene : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Both processes run on the same machine: numbers are stored as in memory.
std::string bytes_of(Scene scene);

/// Reads untrusted bytes. Memory stays within a small multiple of their size. Checks that all indices, sizes
/// and numbers are valid; polygons have at least three corners. Throws DamagedScene.
Scene scene_of(std::string_view bytes);

}  // namespace viete::foreign
