// Entry of a number: key by key during a drag, or as the text of a field.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viete::interact {

/// Parses a number with a decimal point or comma; nullopt if it is not a number or exceeds double.
std::optional<double> number_of(std::string_view text);

class NumberEntry {
public:
  /// Accepts digits, a point (or comma), and minus, which toggles the sign at any position. Returns true if c
  /// was accepted.
  bool type(char c);
  void backspace();

  bool empty() const { return digits_.empty() && !negative_; }
  /// Nullopt before the first digit.
  std::optional<double> value() const;
  std::string text() const { return (negative_ ? "-" : "") + digits_; }

private:
  bool negative_ = false;
  std::string digits_;
};

}  // namespace viete::interact
