#include "scene/number_entry.h"

#include <charconv>

namespace viete::scene {

bool NumberEntry::type(char c) {
  constexpr std::size_t longest = 15;
  if (c == ',') c = '.';
  if (c == '-') {
    negative_ = !negative_;
    return true;
  }
  const bool point = c == '.';
  if (!point && (c < '0' || c > '9')) return false;
  const bool second_point = point && digits_.find('.') != std::string::npos;
  if (!second_point && digits_.size() < longest) digits_ += c;
  return true;
}

void NumberEntry::backspace() {
  if (!digits_.empty()) {
    digits_.pop_back();
  } else {
    negative_ = false;
  }
}

void NumberEntry::clear() {
  *this = {};
}

std::optional<double> NumberEntry::value() const {
  double value = 0;
  const auto parsed = std::from_chars(digits_.data(), digits_.data() + digits_.size(), value);
  if (parsed.ec != std::errc()) return std::nullopt;
  return negative_ ? -value : value;
}

}  // namespace viete::scene
