// Writes numbers as text that reads back exactly; independent of the locale.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
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
    as_printed,  ///< as many decimals as the original file has; without one, as `all`
    all,         ///< the shortest that read back as the same double
    decimals     ///< a fixed number of decimals
  };
  Kind kind = Kind::as_printed;
  int decimals = 0;  ///< for Kind::decimals
};

/// Content of a file to write.
struct Content {
  const mesh::Surface& surface;
  std::span<const mesh::Point> positions;  ///< replace those of the surface
  const std::vector<std::string>& comments;
  const Attributes* attributes = nullptr;  ///< belong to the surface; may be null

  /// The attributes; empty ones if null.
  const Attributes& given() const {
    static const Attributes nothing;
    return attributes ? *attributes : nothing;
  }
};

/// Passes bytes on in portions, so that a large file is never entirely in memory.
class TextWriter {
public:
  explicit TextWriter(base::ByteSink sink, base::Progress* progress = nullptr, Digits digits = {})
      : sink_(std::move(sink)), progress_(progress), digits_(digits) {}

  const Digits& digits() const { return digits_; }

  TextWriter& text(std::string_view s) {
    out_.append(s);
    return *this;
  }

  /// The shortest digits (17 at most) that read back exactly.
  TextWriter& number(double value) { return shortest(value); }
  TextWriter& number(float value) { return shortest(value); }
  TextWriter& number(std::uint64_t value) { return shortest(value); }

  template <class Number>
  TextWriter& little_endian(Number value) {
    const auto raw = bytes_of_number(value);
    return text({raw.data(), raw.size()});
  }

  TextWriter& point(const mesh::Point& p) {
    return number(p[0]).text(" ").number(p[1]).text(" ").number(p[2]);
  }

  /// Writes each line after the mark; line ends and control characters become blanks.
  void comments(std::string_view mark, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) text(mark).text(one_line(line)).text("\n");
  }

  static std::string one_line(std::string text) {
    for (char& c : text) {
      if (static_cast<unsigned char>(c) < 32) c = ' ';
    }
    while (!text.empty() && (text.back() == '\\' || text.back() == ' ')) text.pop_back();
    return text;
  }

  /// Call after each element with the number written and the total. Throws base::Cancelled.
  void element_done(std::size_t count, std::size_t of) {
    constexpr std::size_t portion = 1 << 18;
    if (out_.size() < portion) return;
    finish();
    if (progress_) progress_->report(static_cast<double>(count) / static_cast<double>(of));
  }

  /// Passes on the remaining bytes.
  void finish() {
    sink_(out_);
    out_.clear();
  }

private:
  template <class Number>
  TextWriter& shortest(Number value) {
    char digits[32];
    out_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    return *this;
  }

  base::ByteSink sink_;
  base::Progress* progress_;
  Digits digits_;
  std::string out_;
};

}  // namespace viete::formats
