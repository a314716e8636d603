// Material libraries of OBJ files (MTL): the base colour and its image.
#pragma once

#include <string>
#include <vector>

#include "formats/attributes.h"
#include "formats/source.h"
#include "formats/surface_builder.h"

namespace viete::formats {

/// A `newmtl` section: the statements Kd, d, Tr and map_Kd, and the file names of other maps.
struct MtlMaterial {
  Material material;                        ///< base_color_image is not set
  std::filesystem::path image;              ///< path of map_Kd; the file can be missing; empty without map_Kd
  std::vector<std::filesystem::path> maps;  ///< files of all maps, including `image`
};

/// Reads a material library and skips unreadable lines. source.folder must be the folder of the library.
std::vector<MtlMaterial> read_mtl(const Source& source);

/// Sets colours and images of the model's materials by name. `libraries` has the text after the keyword of
/// each `mtllib` line. The text is one file name, perhaps with blanks, or several file names. Files are
/// relative to source.folder; if source.folder is empty, does nothing. If there are materials and a library
/// is unreadable, adds a warning. Returns the paths of all libraries and images.
std::vector<std::filesystem::path> read_materials(const Source& source,
                                                  const std::vector<std::string>& libraries,
                                                  Attributes& attributes, SurfaceBuilder& builder);

}  // namespace viete::formats
