// The words that lines of an OBJ file start with, and the indices of a face's corner.
#pragma once

#include <cstdint>
#include <string_view>

#include "mesh/formats/text_cursor.h"

namespace viete::mesh {

inline constexpr TextRules obj_rules{.comment = '#', .continued_lines = true};

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
  other,   ///< of OBJ, but nothing that a surface has
  unknown  ///< not of OBJ
};

/// In small letters or, as some programs write them, in capitals.
ObjWord obj_word(std::string_view word);
/// In small letters only.
ObjWord small_obj_word(std::string_view word);

/// True for what stands behind a block of vertices and normals: lines added to the block come before it.
inline bool ends_block(ObjWord word) {
  return word >= ObjWord::face && word <= ObjWord::use_material;
}

/// What stands behind a corner's vertex index: "", "/2", "//3", "/2/3".
struct ObjIndices {
  std::int64_t texture_point = 0, normal = 0;  ///< as the file has them: from 1, or relative; 0: none
  std::string_view normal_word;                ///< where the normal's index stands
  bool readable = true;                        ///< false: no such form; both are 0
};

ObjIndices obj_indices(std::string_view behind_vertex);

}  // namespace viete::mesh
