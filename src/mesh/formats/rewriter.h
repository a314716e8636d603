// Copies the bytes of a file and replaces some words.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "mesh/formats/printed.h"
#include "mesh/formats/text_cursor.h"
#include "mesh/formats/text_writer.h"
#include "mesh/normals.h"
#include "mesh/surface.h"
#include "mesh/vector.h"

namespace viete::mesh {

using ThreeWords = std::array<std::string_view, 3>;

/// The next three words of the line; missing ones are empty.
inline ThreeWords three_words(TextCursor& text) {
  return {text.word(), text.word(), text.word()};  // from left to right
}

/// NaN for words that are not numbers.
inline Vec3 vector_in(const ThreeWords& words) {
  Vec3 v{};
  for (std::size_t i = 0; i < 3; ++i) v[i] = number_in(words[i]).value_or(std::nan(""));
  return v;
}

/// A direction whose format is learned. Missing words give 0 0 0, which is kept.
inline Vec3 learned_direction(const ThreeWords& words, Printed& printed) {
  if (words[2].empty()) return {0, 0, 0};
  const Vec3 direction = vector_in(words);
  if (is_direction(direction)) {
    for (const std::string_view word : words) printed.learn(word);
  }
  return direction;
}

/// Replacements must be in file order; everything between them is copied.
class Rewriter {
public:
  Rewriter(std::string_view bytes, TextWriter& out) : bytes_(bytes), out_(out) {}

  /// word must point into the bytes.
  void replace(std::string_view word, std::string_view by) {
    copy_until(offset_of(word));
    out_.text(by);
    copied_ += word.size();
  }

  /// Replaces the words of a vector that changed. Components that print alike stay.
  void replace(const ThreeWords& words, const Vec3& before, const Vec3& now, const Printed& printed) {
    if (!changed(before, now)) return;
    std::array<char, 400> room;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!printed.same(before[i], now[i])) replace(words[i], printed.print(now[i], room));
    }
  }

  /// Copies up to an offset, for insertions there.
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

  std::size_t offset_of(std::string_view word) const {
    return static_cast<std::size_t>(word.data() - bytes_.data());
  }

private:
  std::string_view bytes_;
  TextWriter& out_;
  std::size_t copied_ = 0;
};

/// Rewrites a text with rows of positions and optional normals; prints changed values. walk(position, normal)
/// calls position(row, words), which returns whether to continue, and normal(row, words) in file order.
/// vertex_of(row): the vertex of a position. Learns the number format from the first `enough` positions.
template <class Walk, class VertexOf>
void rewrite_vectors(std::string_view bytes, TextWriter& out, const Surface& rest,
                     std::span<const Point> positions, std::size_t enough, const VertexOf& vertex_of,
                     std::size_t normals, std::span<const std::uint32_t> normal_of_corner,
                     std::span<const std::uint32_t> vertex_of_normal, const Walk& walk) {
  Printed coordinates(out.digits()), directions(out.digits());
  std::vector<Vec3> before(normals);
  walk(
      [&](std::size_t row, const ThreeWords& words) {
        for (const std::string_view word : words) {
          if (row < enough) coordinates.learn(word);
        }
        return normals > 0 || row < enough;
      },
      [&](std::size_t row, const ThreeWords& words) { before[row] = learned_direction(words, directions); });
  coordinates.keep(6, bounds(rest.positions).diagonal());
  directions.keep(5, 1);
  std::vector<Vec3> now = before;
  if (normals > 0) now = deformed_normals(rest, positions, before, normal_of_corner, vertex_of_normal);
  keep_lengths(before, now);
  Rewriter rewriter(bytes, out);
  walk(
      [&](std::size_t row, const ThreeWords& words) {
        const std::uint32_t v = vertex_of(row);
        rewriter.replace(words, rest.positions[v], positions[v], coordinates);
        return true;
      },
      [&](std::size_t row, const ThreeWords& words) {
        rewriter.replace(words, before[row], now[row], directions);
      });
  rewriter.finish();
}

}  // namespace viete::mesh
