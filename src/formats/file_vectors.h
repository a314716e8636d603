// Vectors of numbers and their places in a file, recorded while reading, to be written again with other
// values.
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

/// Rows of three numbers: positions, or the directions that depend on them. Rows are in file order.
struct FileVectors {
  enum class Kind { positions, normals, tangents };
  enum class Rows { vertices, corners, faces };
  using Places = std::array<std::size_t, 3>;

  Kind kind = Kind::positions;
  Rows rows = Rows::vertices;  ///< row i is of vertex i, or of Surface::corners[i], or see row_of_corner
  std::string element;         ///< for messages
  std::size_t count = 0;       ///< number of rows
  /// Offsets of a row's numbers in the file, in the same order in every row; no_places: the row stays.
  std::function<Places(std::size_t row)> places = {};
  std::array<NumberType, 3> types{NumberType::float64, NumberType::float64, NumberType::float64};
  /// Only for Rows::faces: returns the row of a corner's normal, or mesh::none.
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

/// The places of the next three words of the line; moves past them. no_places if there are fewer.
FileVectors::Places places_of_three(TextCursor& text);

/// The file kept as read, to be written again: everything stays except for moved positions and the directions
/// around them. Numbers are rounded to their type in the file; text gets as many decimals as in the file, and
/// at least six significant digits of the model's diagonal.
struct VectorFile {
  std::string_view format;  ///< its name in the table of formats
  bool text = true;
  std::endian order = std::endian::little;  ///< of binary numbers
  std::vector<FileVectors> vectors = {};
  std::vector<std::string> beyond_attributes = {};  ///< see Original
  Companions companions = {};                       ///< see Original
};

/// Null without source.owner. Writing also throws base::Error if a number is out of range of its type.
std::shared_ptr<const Original> original_of(const Source& source, VectorFile file);

}  // namespace viete::formats
