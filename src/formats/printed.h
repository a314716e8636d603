// Prints numbers in the style of a text file, and checks positions before writing.
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

/// A number format, learned from the numbers of a text file or given by Digits.
class Printed {
public:
  explicit Printed(Digits digits = {}) : digits_(digits) {}

  /// Learns from a word of the file, normally a number.
  void learn(std::string_view word);

  /// Ensures enough decimals that a number of this size has at least `significant` digits.
  void keep(int significant, double size);

  /// Prints with decimals or an exponent as learned, and with the largest number of digits learned. If all
  /// learned numbers had the same number of digits, pads with zeros. room: at least 400 bytes.
  std::string_view print(double value, std::span<char> room) const;

  /// True if both numbers print to the same text.
  bool same(double a, double b) const;

private:
  bool exponents() const { return plain_ == 0 && with_exponent_ > 0; }
  int decimals() const;

  Digits digits_;
  int most_ = 0, least_ = 400;  // numbers of decimals learned from numbers without exponent
  int most_mantissa_ = 0;       // number of decimals learned from numbers with exponent
  int needed_ = 0, needed_mantissa_ = 0;
  std::size_t plain_ = 0, with_exponent_ = 0;  // how many numbers of each kind were learned
  bool capital_ = false;                       // prints E instead of e
};

/// Prints with the writer's number of decimals, or with the shortest digits that read back exactly.
void print_point(const mesh::Point& p, TextWriter& out);

inline constexpr double largest_float = std::numeric_limits<float>::max();

/// False if a coordinate is NaN or beyond `largest`.
inline bool is_place(const mesh::Point& p, double largest = mesh::largest_coordinate) {
  return std::abs(p[0]) <= largest && std::abs(p[1]) <= largest && std::abs(p[2]) <= largest;
}

/// Throws base::Error if a coordinate is NaN or beyond `largest`, the limit of the file's number type. place:
/// the file and frame in the message.
void check_written(const std::string& place, std::size_t vertex, const mesh::Point& p,
                   double largest = mesh::largest_coordinate);
/// Checks all vertices. Throws base::Error too if there are none.
void check_written(const std::string& place, std::span<const mesh::Point> positions,
                   double largest = mesh::largest_coordinate);

}  // namespace viete::formats
