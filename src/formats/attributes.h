// Surface attributes in a file, other than positions and polygons: texture coordinates, normals, colours,
// groups, materials and their images.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mesh/surface.h"
#include "mesh/vector.h"

namespace viete::formats {

using Vec2 = std::array<double, 2>;
using Color = std::array<float, 4>;  ///< red, green, blue (sRGB) and opacity, each in [0, 1]

/// The largest size of an image file in bytes. Larger files cannot be decoded.
inline constexpr std::size_t most_image_bytes = std::size_t{1} << 29;

/// An encoded image: an external file, or bytes in the model's file. Only the display decodes images.
struct ImageFile {
  std::filesystem::path path;                ///< absolute path; empty if the image is in the model's file
  std::shared_ptr<const std::string> bytes;  ///< PNG, JPEG ...; null if the image is an external file
  std::string name;                          ///< for messages
};

struct Material {
  std::string name;
  Color base_color{0.8F, 0.8F, 0.8F, 1};
  std::uint32_t base_color_image = mesh::none;  ///< index into images; the image is multiplied by base_color
  bool repeats = true;  ///< false: outside [0, 1], the border colour of the image continues
};

/// Consecutive polygons with the same object, name, material and shading.
struct Group {
  std::uint32_t first_polygon = 0;      ///< the group ends before the first polygon of the next group
  std::string object, name;             ///< may be empty
  std::uint32_t material = mesh::none;  ///< index into Attributes::materials
  bool smooth = true;                   ///< false: flat shading
};

/// Attributes of a surface. Arrays of missing attributes are empty. Corner i is Surface::corners[i].
struct Attributes {
  std::vector<Vec2> texture_points;           ///< (u, v); v increases upwards
  std::vector<std::uint32_t> corner_texture;  ///< for each corner an index into texture_points, or mesh::none
  std::vector<mesh::Vec3> normals;            ///< as in the file; not always unit vectors
  std::vector<std::uint32_t> corner_normal;   ///< for each corner an index into normals, or mesh::none
  std::vector<Color> colors;                  ///< one per vertex
  std::vector<Color> polygon_colors;          ///< one per polygon
  std::vector<Group> groups;                  ///< sorted by first_polygon; the first group starts at 0
  std::vector<Material> materials;
  std::vector<ImageFile> images;

  bool empty() const {
    return texture_points.empty() && normals.empty() && colors.empty() && polygon_colors.empty() &&
           groups.empty() && materials.empty();
  }
};

}  // namespace viete::formats
