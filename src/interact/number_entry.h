// Entering a number, with single keys during a drag or as text in a field.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viete::interact {

/// Parses a number with a decimal point or comma; nullopt for other text and for numbers beyond double.
std::optional<double> number_of(std::string_view text);

class NumberEntry {
public:
  /// Accepts digits, a point or comma, and minus. Minus changes the sign at any time. Returns false if `c` is
  /// another character.
  bool type(char c);
  void backspace();

  bool empty() const { return digits_.empty() && !negative_; }
  /// Returns nullopt before the first digit.
  std::optional<double> value() const;
  std::string text() const { return (negative_ ? "-" : "") + digits_; }

private:
  bool negative_ = false;
  std::string digits_;
};

}  // namespace viete::interact
