// What one unit of a file's coordinates measures. Numbers are never scaled by it: it is what is said with
// them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace viete::scene {

enum class LengthUnit { unknown, millimetre, centimetre, metre, inch, foot };

/// By number.
struct LengthUnitEntry {
  std::string_view symbol;  ///< behind numbers, on buttons and in sessions; "none" of the unknown one
  std::string_view plural;  ///< "millimetres"
  double metres;
};
std::span<const LengthUnitEntry> all_length_units();
const LengthUnitEntry& entry(LengthUnit unit);
std::optional<LengthUnit> length_unit_of_symbol(std::string_view symbol);

/// Metres of glTF, which says so; what a comment of the file's head says, as "File units = centimeters";
/// else unknown: sizes say nothing.
LengthUnit guessed_unit(std::string_view format, const std::vector<std::string>& comments);

/// "12.4 cm", and with a small 2 or 3 for these powers; the number alone, where the unit is not known.
std::string with_unit(const std::string& number, LengthUnit unit, int power = 1);

}  // namespace viete::scene
