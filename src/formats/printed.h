// Prints numbers in the style of a given text file, and checks positions before writing.
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
/// diagonal, otherwise "". `error` is the largest change of a coordinate.
std::string rounding_note(double error, double diagonal);

}  // namespace viete::formats
