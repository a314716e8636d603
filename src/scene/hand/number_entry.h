// A number as it is typed: during a drag, key by key, or as the whole text of a field.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viete::scene {

/// What a text says, with a decimal point or comma; nothing if that is no number, or none that a double
/// holds.
std::optional<double> number_of(std::string_view text);

class NumberEntry {
public:
  /// Digits, a point (or comma), and minus, which changes the sign wherever it is typed. Says whether c was
  /// one of them.
  bool type(char c);
  void backspace();

  bool empty() const { return digits_.empty() && !negative_; }
  /// Nothing before the first digit.
  std::optional<double> value() const;
  std::string text() const { return (negative_ ? "-" : "") + digits_; }

private:
  bool negative_ = false;
  std::string digits_;
};

}  // namespace viete::scene
