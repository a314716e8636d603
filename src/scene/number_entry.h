// A number as it is typed during a drag.
#pragma once

#include <optional>
#include <string>

namespace viete::scene {

class NumberEntry {
public:
  /// Digits, a point (or comma), and minus, which changes the sign wherever it is typed. Says whether c was
  /// one of them.
  bool type(char c);
  void backspace();
  void clear();

  bool empty() const { return digits_.empty() && !negative_; }
  /// Nothing before the first digit.
  std::optional<double> value() const;
  std::string text() const { return (negative_ ? "-" : "") + digits_; }

private:
  bool negative_ = false;
  std::string digits_;
};

}  // namespace viete::scene
