// Material libraries of OBJ files (MTL): the base colour and its image.
#pragma once

#include <string>
#include <vector>

#include "mesh/attributes.h"
#include "mesh/source.h"
#include "mesh/surface_builder.h"

namespace viete::mesh {

/// One `newmtl` of a library. Of its lines Kd, d, Tr and map_Kd are looked at.
struct MtlMaterial {
  Material material;            ///< without its image
  std::filesystem::path image;  ///< absolute; empty: none. Whether it is there, who shows it will see
  bool repeats = true;          ///< false: map_Kd -clamp on
};

/// Never fails: lines that cannot be read are as if they were not there. source.folder is that of the
/// library.
std::vector<MtlMaterial> read_mtl(const Source& source);

/// Fills colours and images of the materials that the model uses, by their names. Each of the libraries is
/// what stood behind `mtllib`: a name, with blanks, or several names, looked for beside the model. One that
/// is missing or cannot be read is a warning. Without source.folder nothing is looked for.
void read_materials(const Source& source, const std::vector<std::string>& libraries, Attributes& attributes,
                    SurfaceBuilder& builder);

}  // namespace viete::mesh
