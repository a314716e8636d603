// Number formatting that imitates a text file, and range checks before writing.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "formats/text_writer.h"
#include "mesh/surface.h"

namespace viete::formats {

/// Format of a text file's numbers, learned from examples or specified.
class Printed {
public:
  explicit Printed(Digits digits = {}) : digits_(digits) {}

  /// Learns from a number of the file. Accepts any text.
  void learn(std::string_view word);

  /// Requires at least that many significant digits for numbers of this size.
  void keep(int significant, double size);

  /// Prints in the learned style: decimals or exponents, with the largest number of digits seen; padded with
  /// zeros if all numbers had equally many digits. room: at least 400 bytes.
  std::string_view print(double value, std::span<char> room) const;

  /// True if both print alike, so that the file's text can stay.
  bool same(double a, double b) const;

private:
  bool exponents() const { return plain_ == 0 && with_exponent_ > 0; }
  int decimals() const;

  Digits digits_;
  int most_ = 0, least_ = 400;  // decimals of numbers without exponent
  int most_mantissa_ = 0;       // decimals of numbers with exponent
  int needed_ = 0, needed_mantissa_ = 0;
  std::size_t plain_ = 0, with_exponent_ = 0;
  bool capital_ = false;  // capital E
};

/// Prints with the writer's digits: fixed decimals, or the shortest that read back exactly.
void print_point(const mesh::Point& p, TextWriter& out);

inline constexpr double largest_float = std::numeric_limits<float>::max();

/// False if a coordinate is NaN or beyond `largest`.
inline bool is_place(const mesh::Point& p, double largest = mesh::largest_coordinate) {
  return std::abs(p[0]) <= largest && std::abs(p[1]) <= largest && std::abs(p[2]) <= largest;
}

/// Throws base::Error if readers would reject the position. largest: limit of the file's number type. place:
/// the file and frame, for the message.
void check_written(const std::string& place, std::size_t vertex, const mesh::Point& p,
                   double largest = mesh::largest_coordinate);
/// Checks all vertices in order.
void check_written(const std::string& place, std::span<const mesh::Point> positions,
                   double largest = mesh::largest_coordinate);

}  // namespace viete::formats
