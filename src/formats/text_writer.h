// Writes text and numbers in portions. Numbers can be read again exactly. The locale has no effect.
#pragma once

#include <charconv>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/atomic_file.h"
#include "base/progress.h"
#include "formats/attributes.h"
#include "formats/byte_order.h"
#include "mesh/surface.h"

namespace viete::formats {

/// Digits of coordinates in text files.
struct Digits {
  enum class Kind {
    as_printed,  ///< as many decimals as in the file that was read; new files use `all`
    all,         ///< the shortest digits from which the exact double can be read
    decimals     ///< a fixed number of decimals
  };
  Kind kind = Kind::as_printed;
  int decimals = 0;  ///< for Kind::decimals
};

/// The content of a file to write.
struct Content {
  const mesh::Surface& surface;
  std::span<const mesh::Point> positions;  ///< these positions are written, not surface.positions
  const std::vector<std::string>& comments;
  const Attributes* attributes = nullptr;  ///< attributes of the surface; may be null

  /// Returns *attributes, or empty attributes for null.
  const Attributes& given() const {
    static const Attributes nothing;
    return attributes ? *attributes : nothing;
  }
};

/// Sends bytes to the sink in portions, so that a large file is never completely in memory.
class TextWriter {
public:
  explicit TextWriter(base::ByteSink sink, base::Progress* progress = nullptr, Digits digits = {})
      : sink_(std::move(sink)), progress_(progress), digits_(digits) {}

  const Digits& digits() const { return digits_; }

  TextWriter& text(std::string_view s) {
    out_.append(s);
    return *this;
  }

  /// Writes the shortest digits (17 at most) from which the exact number can be read.
  template <class Number>
  TextWriter& number(Number value) {
    char digits[32];
    out_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    return *this;
  }

  template <class Number>
  TextWriter& little_endian(Number value) {
    const auto raw = bytes_of_number(value);
    return text({raw.data(), raw.size()});
  }

  TextWriter& point(const mesh::Point& p) {
    return number(p[0]).text(" ").number(p[1]).text(" ").number(p[2]);
  }

  /// Writes each comment on a separate line after the mark.
  void comments(std::string_view mark, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) text(mark).text(one_line(line)).text("\n");
  }

  /// Replaces control characters by blanks. Removes blanks and backslashes at the end.
  static std::string one_line(std::string text) {
    for (char& c : text) {
      if (static_cast<unsigned char>(c) < 32) c = ' ';
    }
    while (!text.empty() && (text.back() == '\\' || text.back() == ' ')) text.pop_back();
    return text;
  }

  /// Call this after each element, with the counts of written and of all elements. Throws base::Cancelled.
  void element_done(std::size_t count, std::size_t of) {
    constexpr std::size_t portion = 1 << 18;
    if (out_.size() < portion) return;
    finish();
    if (progress_) progress_->report(static_cast<double>(count) / static_cast<double>(of));
  }

  /// Sends the remaining bytes.
  void finish() {
    sink_(out_);
    out_.clear();
  }

private:
  base::ByteSink sink_;
  base::Progress* progress_;
  Digits digits_;
  std::string out_;
};

}  // namespace viete::formats
