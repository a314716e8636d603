// Keywords of OBJ lines, the indices of a face's corner, and files to be written again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "formats/original.h"
#include "formats/text_cursor.h"

namespace viete::formats {

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
  other,   ///< valid OBJ, but not part of a surface
  unknown  ///< not OBJ
};

/// Accepts lower case and, as some programs write, upper case.
ObjWord obj_word(std::string_view word);
/// Accepts lower case only.
ObjWord small_obj_word(std::string_view word);

/// True for statements that follow a block of vertices and normals; lines are added before them.
inline bool ends_block(ObjWord word) {
  return word >= ObjWord::face && word <= ObjWord::use_material;
}

/// Parses the text after a corner's vertex index: "", "/2", "//3", "/2/3".
struct ObjIndices {
  std::int64_t texture_point = 0, normal = 0;  ///< as in the file: from 1, or relative; 0: none
  std::string_view normal_word;                ///< the text of the normal's index
  bool readable = true;                        ///< false: invalid syntax; both are 0
};

ObjIndices obj_indices(std::string_view behind_vertex);

/// The file kept as read, to be written again. Moved coordinates get as many decimals as in the file, and at
/// least six significant digits of the model's diagonal. Normals are updated; a normal line whose corners now
/// differ gets additional lines after its block, and face indices are renumbered. attributes may be null.
/// normal_blocks: for each block of `vn` lines the number of such lines up to its end, ascending; the last is
/// the total. files: libraries and images.
std::shared_ptr<const Original> obj_original(const Source& source,
                                             std::shared_ptr<const Attributes> attributes,
                                             std::vector<std::uint32_t> normal_blocks,
                                             std::vector<std::filesystem::path> files);

}  // namespace viete::formats
