// Enters a number: by single keys during a drag, or as text in a field.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viete::interact {

/// Parses a number with a decimal point or comma. Returns nullopt for other text and for too large numbers.
std::optional<double> number_of(std::string_view text);

class NumberEntry {
public:
  /// Enters a digit, a point, a comma or a minus. A minus at any place changes the sign. If `c` is another
  /// character, returns false.
  bool type(char c);
  void backspace();

  bool empty() const { return digits_.empty() && !negative_; }
  /// Returns the number, or nullopt if no digit was typed.
  std::optional<double> value() const;
  std::string text() const { return (negative_ ? "-" : "") + digits_; }

private:
  bool negative_ = false;
  std::string digits_;
};

}  // namespace viete::interact
