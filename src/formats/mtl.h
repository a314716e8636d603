// Material libraries of OBJ files (MTL): the base colour and its image.
#pragma once

#include <string>
#include <vector>

#include "formats/attributes.h"
#include "formats/source.h"
#include "formats/surface_builder.h"

namespace viete::formats {

/// A `newmtl` section. Reads Kd, d, Tr and map_Kd, and the file names of other maps.
struct MtlMaterial {
  Material material;                        ///< without its image
  std::filesystem::path image;              ///< absolute, not checked for existence; empty: none
  std::vector<std::filesystem::path> maps;  ///< all images it names, including `image`
};

/// Never fails: skips unreadable lines. source.folder must be the folder of the library.
std::vector<MtlMaterial> read_mtl(const Source& source);

/// Fills in colours and images of the model's materials by name. Each library is the text after `mtllib`: one
/// name with blanks, or several names, in the model's folder. A missing or unreadable library is a warning if
/// there are materials. Returns the libraries and the images that they name, as far as readable. Does nothing
/// if source.folder is empty.
std::vector<std::filesystem::path> read_materials(const Source& source,
                                                  const std::vector<std::string>& libraries,
                                                  Attributes& attributes, SurfaceBuilder& builder);

}  // namespace viete::formats
