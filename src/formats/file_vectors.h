// Records the places of positions, normals and tangents in a file. Rewrites the file with other values, and
// copies all other bytes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/byte_order.h"
#include "formats/original.h"
#include "formats/source.h"
#include "formats/text_cursor.h"
#include "formats/text_writer.h"
#include "mesh/normals.h"
#include "mesh/surface.h"
#include "mesh/vector.h"

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
  std::array<base::NumberType, 3> types{base::NumberType::float64, base::NumberType::float64,
                                        base::NumberType::float64};
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
  Companions companions = {};                       ///< see Original::write_file()
  Capture capture = Capture::none;                  ///< see Original::capture()
};

/// Returns null if source.owner is null. If a number exceeds its type's range, writing throws base::Error.
std::shared_ptr<const Original> original_of(const Source& source, VectorFile file);

/// How numbers are written in a file.
struct NumberForm {
  bool text = true;
  std::endian order = std::endian::little;  ///< byte order of binary numbers
};

/// Returns the text or bytes of a finite value for the file, or nullopt if the value exceeds the type's
/// range. `room` must have at least 400 bytes. `printed` is for text that is not an integer.
std::optional<std::string_view> number_in_file(double value, base::NumberType type, const NumberForm& form,
                                               const Printed& printed, std::span<char> room);

using ThreeWords = std::array<std::string_view, 3>;

/// Returns the next three words of the line. Missing words are empty.
inline ThreeWords three_words(TextCursor& text) {
  return {text.word(), text.word(), text.word()};  // braces evaluate from left to right
}

/// Replacements must be in file order. The bytes between replacements are copied.
class Rewriter {
public:
  Rewriter(std::string_view bytes, TextWriter& out) : bytes_(bytes), out_(out) {}

  /// `word` must be a view of a part of the bytes.
  void replace(std::string_view word, std::string_view by) {
    copy_until(static_cast<std::size_t>(word.data() - bytes_.data()));
    out_.text(by);
    copied_ += word.size();
  }

  /// Replaces the words of changed components. If the text of a component does not change, the word stays.
  void replace(const ThreeWords& words, const mesh::Vec3& before, const mesh::Vec3& now,
               const Printed& printed) {
    if (!mesh::changed(before, now)) return;
    std::array<char, 400> room;
    for (std::size_t i = 0; i < 3; ++i)
      if (!printed.same(before[i], now[i])) replace(words[i], printed.print(now[i], room));
  }

  /// Copies the bytes before this offset. The caller can then insert text.
  void copy_until(std::size_t offset) {
    constexpr std::size_t portion = 1 << 18;
    while (copied_ < offset) {
      const std::size_t size = std::min(portion, offset - copied_);
      out_.text(bytes_.substr(copied_, size));
      copied_ += size;
      out_.element_done(copied_, bytes_.size());
    }
  }

  /// Leaves out the bytes before this offset that are not yet copied.
  void skip_until(std::size_t offset) { copied_ = offset; }

  void finish() { copy_until(bytes_.size()); }

private:
  std::string_view bytes_;
  TextWriter& out_;
  std::size_t copied_ = 0;
};

}  // namespace viete::formats
