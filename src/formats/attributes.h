// Surface attributes in a file, other than positions and polygons: texture coordinates, normals, colours,
// groups, materials and their images. Conversions between the attributes of files.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/surface.h"
#include "mesh/vector.h"

namespace viete::formats {

using Vec2 = std::array<double, 2>;
using Color = std::array<float, 4>;  ///< red, green, blue (sRGB) and opacity, each in [0, 1]

/// The largest size of an image file in bytes. Larger files cannot be decoded.
inline constexpr std::size_t most_image_bytes = std::size_t{1} << 29;

/// An encoded image: an external file, or bytes in the model's file. Only the display and conversions decode
/// images.
struct ImageFile {
  std::filesystem::path path;                ///< absolute path; empty if the image is in the model's file
  std::shared_ptr<const std::string> bytes;  ///< PNG, JPEG ...; null if the image is an external file
  std::string name;                          ///< for messages
};

/// The properties of glTF's metallic-roughness model. Images are indices into Attributes::images, or
/// mesh::none. Numbers are multiplied by their images. The display uses only the base colour.
struct Material {
  std::string name;
  Color base_color{0.8F, 0.8F, 0.8F, 1};
  float metallic = 0, roughness = 0.5F;  ///< in [0, 1]
  Color emission{0, 0, 0, 1};            ///< the opacity is ignored
  std::uint32_t base_color_image = mesh::none;
  std::uint32_t metallic_image = mesh::none;   ///< the blue channel, or a grey image
  std::uint32_t roughness_image = mesh::none;  ///< the green channel, or a grey image
  std::uint32_t normal_image = mesh::none;     ///< normals in tangent space; y points up
  std::uint32_t emission_image = mesh::none;
  bool is_translucent = false;  ///< true if the base colour image contains opacities
  bool repeats = true;          ///< false: outside [0, 1], the border colour of the images continues

  friend bool operator==(const Material&, const Material&) = default;
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

/// Returns the attributes with normals that match the moved positions.
Attributes deformed_attributes(const mesh::Surface& rest, std::span<const mesh::Point> positions,
                               const Attributes& attributes);

/// Copies of normals. If several vertices or flat-shaded polygons have the same normal, each gets a copy. A
/// deformation can then change each copy separately.
struct SpreadNormals {
  std::vector<mesh::Vec3> normals;   ///< all copies of original normal 0, then all copies of normal 1, ...
  std::vector<std::uint32_t> first;  ///< index of each original normal's first copy; last: normals.size()
  std::vector<std::uint32_t> of_corner;  ///< for each corner an index into normals, or mesh::none

  /// `attributes` must have normals and corner indices.
  SpreadNormals(const mesh::Surface& surface, const Attributes& attributes);
};

/// `of_corner` has an index or mesh::none for each corner. If no vertex has two different indices, returns
/// the index of each vertex, or mesh::none for a vertex without an index. Otherwise, returns nullopt.
std::optional<std::vector<std::uint32_t>> one_a_vertex(const mesh::Surface& surface,
                                                       const std::vector<std::uint32_t>& of_corner);

/// Returns true if there are groups and all groups have flat shading.
bool is_flat(const Attributes& attributes);

/// A colour in a text file. Components are from 0 to 1 or from 0 to 255.
struct WrittenColor {
  std::uint32_t element = 0;  ///< index of the vertex or polygon
  Color color{};
  bool whole = true;  ///< true if red, green and blue are integers

  /// `numbers` and `are_whole` are the results of TextCursor::numbers(): three or four, or none for black.
  WrittenColor(std::size_t element, std::span<const double> numbers, std::span<const bool> are_whole);
};

/// Returns the colour of each element, in [0, 1], or no colours if `written` is empty. Elements without a
/// colour get `missing`. If one of the whole colours exceeds 1, divides all whole colours by 255; likewise
/// for the other colours. Opacities up to 1 stay.
std::vector<Color> colors_of_elements(std::span<const WrittenColor> written, std::size_t elements,
                                      const Color& missing);

/// Converts a value in [0, 1] to an integer from 0 to 255. Values outside are clamped.
std::uint8_t color_byte(float value);

}  // namespace viete::formats
