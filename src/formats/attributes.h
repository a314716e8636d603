// Surface attributes of a file besides positions and polygons: texture coordinates, normals, colours, groups,
// materials and their images.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "mesh/surface.h"
#include "mesh/vector.h"

namespace viete::formats {

using Vec2 = std::array<double, 2>;
using Color = std::array<float, 4>;  ///< red, green, blue, opacity in [0, 1], sRGB as stored

/// Size limit of model images; larger files are rejected.
inline constexpr std::size_t most_image_bytes = std::size_t{1} << 29;

/// An encoded image, in a file of its own or embedded in the model's file. Decoded only for display.
struct ImageFile {
  std::filesystem::path path;                ///< absolute path; empty if embedded
  std::shared_ptr<const std::string> bytes;  ///< encoded bytes (PNG, JPEG ...) if embedded; otherwise null
  std::string name;                          ///< for messages
};

struct Material {
  std::string name;
  Color base_color{0.8F, 0.8F, 0.8F, 1};
  std::uint32_t base_color_image = mesh::none;  ///< index into Attributes::images; multiplied by base_color
  bool repeats = true;  ///< outside [0, 1] the image repeats; false: clamps to its border
};

/// Consecutive polygons grouped by the file. A file without groups has one.
struct Group {
  std::uint32_t first_polygon = 0;      ///< the group ends at the first polygon of the next one
  std::string object, name;             ///< either may be empty
  std::uint32_t material = mesh::none;  ///< index into Attributes::materials
  bool smooth = true;                   ///< false: flat shading
};

/// Arrays are empty if the file does not have the attribute. Corners are indexed as Surface::corners.
struct Attributes {
  std::vector<Vec2> texture_points;           ///< (u, v), v upward
  std::vector<std::uint32_t> corner_texture;  ///< a texture point per corner, or none
  std::vector<mesh::Vec3> normals;            ///< as stored: not necessarily unit vectors
  std::vector<std::uint32_t> corner_normal;   ///< a normal per corner, or none
  std::vector<Color> colors;                  ///< one per vertex
  std::vector<Color> polygon_colors;          ///< one per polygon
  std::vector<Group> groups;                  ///< sorted by first_polygon; the first starts at 0
  std::vector<Material> materials;
  std::vector<ImageFile> images;

  bool empty() const {
    return texture_points.empty() && normals.empty() && colors.empty() && polygon_colors.empty() &&
           groups.empty() && materials.empty();
  }
};

}  // namespace viete::formats
