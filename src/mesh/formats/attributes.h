// What a file says of a surface besides positions and polygons: texture coordinates, normals, colours,
// groups, materials and their images.
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

namespace viete::mesh {

using Vec2 = std::array<double, 2>;
using Color = std::array<float, 4>;  ///< red, green, blue, opacity in [0, 1], as the file has them (sRGB)

/// Larger files are no images of a model, whatever it says.
inline constexpr std::size_t most_image_bytes = std::size_t{1} << 29;

/// A picture as it is stored: beside the model, or within its file. Decoded only by who shows it.
struct ImageFile {
  std::filesystem::path path;  ///< where it lies, as the model names it made absolute; empty: within
  std::shared_ptr<const std::string>
      bytes;         ///< encoded (PNG, JPEG ...) when it lies within the file; or null
  std::string name;  ///< how messages call it
};

struct Material {
  std::string name;
  Color base_color{0.8F, 0.8F, 0.8F, 1};
  std::uint32_t base_color_image = none;  ///< of Attributes::images; its colour is multiplied by base_color
  bool repeats = true;                    ///< the image, beyond [0, 1]; otherwise its border goes on
};

/// Consecutive polygons that the file holds together; those of a file without groups are one.
struct Group {
  std::uint32_t first_polygon = 0;  ///< up to the first of the next group
  std::string object, name;         ///< either may be empty
  std::uint32_t material = none;    ///< of Attributes::materials
  bool smooth = true;               ///< false: the file asks for flat faces there
};

/// Each array is empty where the file has none of it. A corner is an index into Surface::corners.
struct Attributes {
  std::vector<Vec2> texture_points;           ///< (u, v), v upward
  std::vector<std::uint32_t> corner_texture;  ///< of each corner: a texture point, or none
  std::vector<Vec3> normals;                  ///< as the file has them: not all need be unit vectors
  std::vector<std::uint32_t> corner_normal;   ///< of each corner: a normal, or none
  std::vector<Color> colors;                  ///< one a vertex
  std::vector<Color> polygon_colors;          ///< one a polygon
  std::vector<Group> groups;                  ///< by first_polygon, the first at 0
  std::vector<Material> materials;
  std::vector<ImageFile> images;

  bool empty() const {
    return texture_points.empty() && normals.empty() && colors.empty() && polygon_colors.empty() &&
           groups.empty() && materials.empty();
  }
};

}  // namespace viete::mesh
