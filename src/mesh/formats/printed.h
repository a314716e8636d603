// Numbers as files have them: printed like those of a text, and within what a format can hold.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "mesh/formats/text_writer.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// How the numbers of a text file are printed: learned from them, or asked for.
class Printed {
public:
  explicit Printed(Digits digits = {}) : digits_(digits) {}

  /// A number of the file. Any text may be given.
  void learn(std::string_view word);

  /// At least so many significant digits of a number of this size, whatever was learned.
  void keep(int significant, double size);

  /// Like the numbers learned: decimals or exponents, with the most digits found in one of them; with zeros
  /// at the end where all had the same number of digits. Room for 400 bytes.
  std::string_view print(double value, std::span<char> room) const;

  /// True if both would be printed alike, so that the file's own word may stay.
  bool same(double a, double b) const;

private:
  bool exponents() const { return plain_ == 0 && with_exponent_ > 0; }
  int decimals() const;

  Digits digits_;
  int most_ = 0, least_ = 400;  // decimals of numbers without exponent
  int most_mantissa_ = 0;       // decimals of numbers with one
  int needed_ = 0, needed_mantissa_ = 0;
  std::size_t plain_ = 0, with_exponent_ = 0;
  bool capital_ = false;  // E
};

/// With the writer's digits: so many decimals, or the shortest that read back as the same numbers.
void print_point(const Point& p, TextWriter& out);

inline constexpr double largest_float = std::numeric_limits<float>::max();

/// False also where a coordinate is not a number.
inline bool is_place(const Point& p, double largest = largest_coordinate) {
  return std::abs(p[0]) <= largest && std::abs(p[1]) <= largest && std::abs(p[2]) <= largest;
}

/// Throws base::Error where such a position is none that a reader would take again. largest: of the numbers
/// that the file holds. place: the file, its frame.
void check_written(const std::string& place, std::size_t vertex, const Point& p,
                   double largest = largest_coordinate);
/// The same of all vertices, the first one first.
void check_written(const std::string& place, std::span<const Point> positions,
                   double largest = largest_coordinate);

}  // namespace viete::mesh
