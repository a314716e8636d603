#include "interact/number_entry.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace viete::interact {

std::optional<double> number_of(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  std::string digits(text);
  std::replace(digits.begin(), digits.end(), ',', '.');
  double value = 0;
  const char* end = digits.data() + digits.size();
  const auto parsed = std::from_chars(digits.data(), end, value);
  const bool whole = parsed.ec == std::errc() && parsed.ptr == end;
  if (!whole || !std::isfinite(value)) return std::nullopt;
  return value;
}

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

std::optional<double> NumberEntry::value() const {
  const auto value = number_of(digits_);
  return value && negative_ ? -*value : value;
}

}  // namespace viete::interact
