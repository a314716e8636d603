// The names of material properties in formats. Conversions of materials and their images.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/atomic_file.h"
#include "formats/attributes.h"
#include "formats/source.h"
#include "formats/surface_builder.h"

namespace viete::formats {

/// The names of an image property. To add an image to materials, add a member to Material and a row.
struct MaterialImage {
  std::uint32_t Material::*image;
  std::string_view name;    ///< for messages
  const char* gltf_parent;  ///< the JSON object with the texture; null for the material itself
  const char* gltf;
  std::string_view mtl;  ///< with options
};
inline constexpr MaterialImage material_images[] = {
    {&Material::base_color_image, "textures", "pbrMetallicRoughness", "baseColorTexture", "map_Kd"},
    {&Material::metallic_image, "metallic textures", "pbrMetallicRoughness", "metallicRoughnessTexture",
     "map_Pm -imfchan b"},
    {&Material::roughness_image, "roughness textures", "pbrMetallicRoughness", "metallicRoughnessTexture",
     "map_Pr -imfchan g"},
    {&Material::normal_image, "normal textures", nullptr, "normalTexture", "map_Bump -bm 1"},
    {&Material::emission_image, "emission textures", nullptr, "emissiveTexture", "map_Ke"}};

/// The names of a number.
struct MaterialNumber {
  float Material::*number;
  std::uint32_t Material::*image;
  const char* gltf;      ///< a member of pbrMetallicRoughness; if missing, 1
  std::string_view mtl;  ///< if missing, 1 with an image, otherwise the default of Material
};
inline constexpr MaterialNumber material_numbers[] = {
    {&Material::metallic, &Material::metallic_image, "metallicFactor", "Pm"},
    {&Material::roughness, &Material::roughness_image, "roughnessFactor", "Pr"}};

float linear_of_srgb(float x);
/// Converts linear light. Values outside [0, 1] are clamped.
float srgb_of_linear(double x);

/// Gives each distinct colour of polygons a material, and removes polygon_colors. If there are materials or
/// more than 1000 colours, changes nothing and returns false.
bool make_materials_of_colors(std::size_t polygons, Attributes& attributes);

/// Sets polygon_colors to the base colours of materials. If there are colours, or if all base colours are
/// the default colour or belong to images, changes nothing and returns false.
bool make_colors_of_materials(std::size_t polygons, Attributes& attributes);

/// Returns TextWriter::one_line() without comment marks.
std::string name_in_library(const std::string& name);

/// Gives all materials different names for a material library. If only some groups have materials, gives the
/// others a new default material.
void complete_materials(Attributes& attributes);

/// Gives each image of a material bytes in PNG or JPEG format, and combines images of metallic and roughness
/// into one. Removes images from the materials that cannot be read, and grey images of normals, because these
/// are heights. Returns messages for the user.
std::vector<std::string> embed_images(Attributes& attributes);

/// Adds the base colour images (or if `all`, all images) of materials to `files`, in the folder of `model`,
/// and sets ImageFile::name to the relative path. Images that are already in the folder or below stay.
/// Never replaces files. Removes images from the materials that cannot be read or are not image files.
/// Returns messages.
std::vector<std::string> put_images_beside(const std::filesystem::path& model, bool all,
                                           Attributes& attributes, base::FilesTogether& files);

/// A `newmtl` section.
struct MtlMaterial {
  Material material;                        ///< its images are indices into `maps`
  std::vector<std::filesystem::path> maps;  ///< the files of all maps; files can be missing
  std::set<std::string> ignored;            ///< statements of maps that are not in `material`: "disp"
};

/// Reads a material library and skips unreadable lines. source.folder must be the folder of the library.
std::vector<MtlMaterial> read_mtl(const Source& source);

struct MaterialFiles {
  std::vector<std::filesystem::path> files;  ///< paths of all libraries and images
  std::set<std::string> ignored;             ///< statements of maps that are not in Material
};

/// Sets the properties of the model's materials by name. `libraries` has the text after the keyword of
/// each `mtllib` line. The text is one file name, perhaps with blanks, or several file names. Files are
/// relative to source.folder; if source.folder is empty, does nothing. If there are materials and a library
/// is unreadable, adds a warning.
MaterialFiles read_materials(const Source& source, const std::vector<std::string>& libraries,
                             Attributes& attributes, SurfaceBuilder& builder);

}  // namespace viete::formats
