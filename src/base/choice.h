// User choices: the values of an enumeration with names and descriptions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace viete::base {

struct Choice {
  std::string_view word;   ///< in files and command names
  std::string_view label;  ///< in lists
  std::string_view hint;   ///< one sentence
};

/// The choices of an enumeration; each enumeration overloads it in its namespace.
template <class Value>
std::span<const Choice> choices(Value) = delete;

template <class Value>
const Choice& entry_of(Value value) {
  return choices(value)[static_cast<std::size_t>(value)];
}

/// Nothing if no value has this word.
template <class Value>
std::optional<Value> value_of_word(std::string_view word) {
  const std::span<const Choice> all = choices(Value{});
  const auto found = std::ranges::find(all, word, &Choice::word);
  if (found == all.end()) return std::nullopt;
  return static_cast<Value>(found - all.begin());
}

/// The next value, cyclically.
template <class Value>
Value next_choice(Value value) {
  return static_cast<Value>((static_cast<std::size_t>(value) + 1) % choices(value).size());
}

}  // namespace viete::base
