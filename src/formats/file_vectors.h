// Records the places of positions, normals and tangents in a file. Rewrites the file with other values.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "formats/byte_order.h"
#include "formats/original.h"
#include "formats/source.h"
#include "formats/text_cursor.h"

namespace viete::formats {

/// A list of positions, normals or tangents in a file. Each row has three numbers. Rows are in file order.
struct FileVectors {
  enum class Kind { positions, normals, tangents };
  enum class Rows { vertices, corners, faces };
  using Places = std::array<std::size_t, 3>;

  Kind kind = Kind::positions;
  Rows rows = Rows::vertices;  ///< row i belongs to vertex i or corner i; for faces see row_of_corner
  std::string element;         ///< name of a row in messages
  std::size_t count = 0;       ///< number of rows
  /// Returns the offsets of the row's three numbers in the file, or no_places for a row that never changes.
  std::function<Places(std::size_t row)> places = {};
  std::array<NumberType, 3> types{NumberType::float64, NumberType::float64, NumberType::float64};
  /// For Rows::faces: returns the row of the face to which the corner belongs, or mesh::none.
  std::function<std::uint32_t(std::size_t corner)> row_of_corner = {};

  void set_places(std::vector<Places> list) {
    count = list.size();
    places = [list = std::move(list)](std::size_t row) { return list[row]; };
  }
};

inline constexpr FileVectors::Places no_places = [] {
  constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();
  return FileVectors::Places{nowhere, nowhere, nowhere};
}();

/// Moves past the next three words of the line. Returns their offsets, or no_places if a word is missing.
FileVectors::Places places_of_three(TextCursor& text);

/// Describes a file so that it can be rewritten. Rewriting changes moved positions, and the normals and
/// tangents that depend on moved positions. Numbers are rounded to their type in the file. New text has as
/// many decimals as the old text, but at least six significant digits relative to the model's diagonal.
struct VectorFile {
  std::string_view format;  ///< Format::name
  bool text = true;
  std::endian order = std::endian::little;  ///< byte order of binary numbers
  std::vector<FileVectors> vectors = {};
  std::vector<std::string> beyond_attributes = {};  ///< see Original::beyond_attributes()
  Companions companions = {};                       ///< see Original::companions()
  bool is_capture = false;                          ///< see Original::is_capture()
};

/// Returns null if source.owner is null. If a number exceeds its type's range, writing throws base::Error.
std::shared_ptr<const Original> original_of(const Source& source, VectorFile file);

}  // namespace viete::formats
