// Writes text and numbers in portions. Numbers can be read again exactly, or have the style of a given text
// file. Checks positions before writing. The locale has no effect.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/atomic_file.h"
#include "base/byte_order.h"
#include "base/progress.h"
#include "formats/attributes.h"
#include "mesh/splats.h"
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
  /// Posed splats, one per position. Invalid numbers keep those of the file. If null, only unmoved captures.
  const mesh::Splats* splats = nullptr;
  /// For a capture: the vertex of `surface` from which each written vertex takes its other properties. If
  /// empty, each vertex takes its own.
  std::span<const std::uint32_t> sources = {};
  std::string library = {};  ///< the file name of the material library; may be empty

  /// Returns *attributes, or empty attributes for null.
  const Attributes& given() const {
    static const Attributes nothing;
    return attributes ? *attributes : nothing;
  }

  /// Returns true if there is nothing to change in the file of `surface`.
  bool is_at_rest() const { return sources.empty() && std::ranges::equal(surface.positions, positions); }
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
    const auto raw = base::bytes_of_number(value);
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
    for (char& c : text)
      if (static_cast<unsigned char>(c) < 32) c = ' ';
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

/// Returns the bytes that write(out) writes.
template <class Write>
std::string written_text(const Write& write, Digits digits = {}) {
  std::string bytes;
  TextWriter out([&](std::string_view portion) { bytes += portion; }, nullptr, digits);
  write(out);
  out.finish();
  return bytes;
}

/// A number format, defined by Digits or detected from the numbers of a text file by learn().
class Printed {
public:
  explicit Printed(Digits digits = {}) : digits_(digits) {}

  void learn(std::string_view word);

  /// Sets a minimum of decimals: a number as large as `size` gets at least `significant` digits.
  void keep(int significant, double size);

  /// Prints as many decimals as the learned number with the most decimals. If all learned numbers have an
  /// exponent, prints an exponent. If learned numbers differ in decimals, removes zeros at the end. `room`
  /// must have at least 400 bytes.
  std::string_view print(double value, std::span<char> room) const;

  /// Returns true if a and b are printed as equal text.
  bool same(double a, double b) const;

private:
  bool exponents() const { return plain_ == 0 && with_exponent_ > 0; }
  int decimals() const;

  Digits digits_;
  int most_ = 0, least_ = 400;  // the most and fewest decimals of numbers without exponent
  int most_mantissa_ = 0;       // the most decimals of numbers with exponent
  int needed_ = 0, needed_mantissa_ = 0;
  std::size_t plain_ = 0, with_exponent_ = 0;  // counts of learned numbers without and with exponent
  bool capital_ = false;                       // true if the file uses E instead of e
};

/// Prints with the writer's fixed decimals. Without fixed decimals, prints the shortest exact digits.
void print_point(const mesh::Point& p, TextWriter& out);

inline constexpr double largest_float = std::numeric_limits<float>::max();

/// Returns false if a coordinate is NaN or exceeds `largest`.
inline bool is_place(const mesh::Point& p, double largest = mesh::largest_coordinate) {
  return std::abs(p[0]) <= largest && std::abs(p[1]) <= largest && std::abs(p[2]) <= largest;
}

/// Throws base::Error if a coordinate is NaN or exceeds `largest`, the limit of the file's number type.
/// `place` is the file and frame for the message.
void check_written(const std::string& place, std::size_t vertex, const mesh::Point& p,
                   double largest = mesh::largest_coordinate);
/// Checks all vertices. Also throws base::Error if there are no vertices.
void check_written(const std::string& place, std::span<const mesh::Point> positions,
                   double largest = mesh::largest_coordinate);

/// Returns a warning if the number type of a file changes a coordinate by more than 5e-7 of the model's
/// diagonal, otherwise nothing. `error` is the largest change of a coordinate.
std::vector<std::string> rounding_notes(double error, double diagonal);

}  // namespace viete::formats
