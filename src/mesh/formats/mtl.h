// Material libraries of OBJ files (MTL): the base colour and its image.
#pragma once

#include <string>
#include <vector>

#include "mesh/formats/attributes.h"
#include "mesh/formats/source.h"
#include "mesh/formats/surface_builder.h"

namespace viete::mesh {

/// A `newmtl` section. Reads Kd, d, Tr and map_Kd, and the file names of other maps.
struct MtlMaterial {
  Material material;                        ///< without its image
  std::filesystem::path image;              ///< absolute, not checked for existence; empty: none
  std::vector<std::filesystem::path> maps;  ///< all images it names, including `image`
};

/// Never fails: skips unreadable lines. source.folder must be the folder of the library.
std::vector<MtlMaterial> read_mtl(const Source& source);

/// The libraries and the images that they name, as far as readable. See read_materials().
std::vector<std::filesystem::path> files_of_libraries(const std::filesystem::path& folder,
                                                      const std::vector<std::string>& libraries);

/// Fills in colours and images of the model's materials by name. Each library is the text after `mtllib`: one
/// name with blanks, or several names, in the model's folder. A missing or unreadable library is a warning.
/// Does nothing if source.folder is empty.
void read_materials(const Source& source, const std::vector<std::string>& libraries, Attributes& attributes,
                    SurfaceBuilder& builder);

}  // namespace viete::mesh
