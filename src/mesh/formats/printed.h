// Numbers printed the way a text file has them.
#pragma once

#include <span>
#include <string_view>

#include "mesh/formats/text_writer.h"

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

}  // namespace viete::mesh
