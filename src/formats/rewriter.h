// Copies a text file and replaces some words.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "formats/printed.h"
#include "formats/text_cursor.h"
#include "formats/text_writer.h"
#include "mesh/normals.h"
#include "mesh/surface.h"
#include "mesh/vector.h"

namespace viete::formats {

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
    for (std::size_t i = 0; i < 3; ++i) {
      if (!printed.same(before[i], now[i])) replace(words[i], printed.print(now[i], room));
    }
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

  void finish() { copy_until(bytes_.size()); }

private:
  std::string_view bytes_;
  TextWriter& out_;
  std::size_t copied_ = 0;
};

}  // namespace viete::formats
