// What reading a file gives.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mesh/formats/attributes.h"
#include "mesh/formats/original.h"
#include "mesh/surface.h"

namespace viete::mesh {

struct ReadResult {
  Surface surface;
  std::string format;                 ///< "OBJ", "PLY ascii", "PLY binary little-endian", "STL binary", ...
  std::vector<std::string> warnings;  ///< one line each, harmless oddities worth a word, with their place
  std::shared_ptr<const Attributes> attributes;  ///< null: nothing but positions and polygons
  std::shared_ptr<const Original> original;      ///< null: it cannot be written again as it was
  std::vector<std::string> comments;  ///< of the file's head, without their mark: at most 64, of 200 bytes
};

}  // namespace viete::mesh
