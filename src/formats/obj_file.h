// Words and corners of OBJ files.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "formats/attributes.h"
#include "formats/materials.h"
#include "formats/original.h"
#include "formats/source.h"
#include "formats/text_cursor.h"

namespace viete::formats {

enum class ObjWord : std::uint8_t {
  vertex,
  texture_point,
  normal,
  face,
  group,
  object,
  smoothing,
  use_material,
  material_library,
  free_form,
  other,   ///< a keyword of OBJ that does not describe a surface
  unknown  ///< not a keyword of OBJ
};

/// Finds the keyword. Ignores the case, because some programs write capitals.
ObjWord obj_word(std::string_view word);
/// Works like obj_word(), but accepts only lower case.
ObjWord small_obj_word(std::string_view word);

/// Returns true for statements that end a block of vertices and normals. A block is v, vt and vn lines.
inline bool ends_block(ObjWord word) {
  return word >= ObjWord::face && word <= ObjWord::use_material;
}

/// The indices of a corner as in the file: absolute from 1, relative from -1, or 0 if missing.
struct ObjIndices {
  std::int64_t texture_point = 0, normal = 0;
  std::string_view normal_word;  ///< the text of the normal's index
  bool readable = true;          ///< false if the syntax is invalid; both indices are then 0
};

/// Parses the text after a corner's vertex index: "", "/2", "//3", "/2/3".
ObjIndices obj_indices(std::string_view behind_vertex);

/// Returns an original that writes the file again with other positions. Moved coordinates get as many
/// decimals as in the file, but at least six significant digits relative to the model's diagonal. If the
/// corners of a `vn` line need different normals, writing adds `vn` lines after the block and renumbers the
/// indices of faces. `attributes` may be null. `normal_blocks` has the number of `vn` lines from the start of
/// the file to the end of each block.
std::shared_ptr<const Original> obj_original(const Source& source,
                                             std::shared_ptr<const Attributes> attributes,
                                             std::vector<std::uint32_t> normal_blocks, MaterialFiles files);

}  // namespace viete::formats
