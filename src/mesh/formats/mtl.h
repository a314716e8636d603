// Material libraries of OBJ files (MTL): the base colour and its image.
#pragma once

#include <string>
#include <vector>

#include "mesh/formats/attributes.h"
#include "mesh/formats/source.h"
#include "mesh/formats/surface_builder.h"

namespace viete::mesh {

/// One `newmtl` of a library. Of its lines Kd, d, Tr and map_Kd are looked at; of other maps the names.
struct MtlMaterial {
  Material material;            ///< without its image
  std::filesystem::path image;  ///< absolute; empty: none. Whether it is there, who shows it will see
  std::vector<std::filesystem::path> maps;  ///< all images that it names, that one too
};

/// Never fails: lines that cannot be read are as if they were not there. source.folder is that of the
/// library.
std::vector<MtlMaterial> read_mtl(const Source& source);

/// The libraries and the images that these name, as far as they can be read. See read_materials().
std::vector<std::filesystem::path> files_of_libraries(const std::filesystem::path& folder,
                                                      const std::vector<std::string>& libraries);

/// Fills colours and images of the materials that the model uses, by their names. Each of the libraries is
/// what stood behind `mtllib`: a name, with blanks, or several names, looked for beside the model. One that
/// is missing or cannot be read is a warning. Without source.folder nothing is looked for.
void read_materials(const Source& source, const std::vector<std::string>& libraries, Attributes& attributes,
                    SurfaceBuilder& builder);

}  // namespace viete::mesh
