// The names and descriptions of an enumeration's values, for users.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace viete::base {

struct Choice {
  std::string_view word;   ///< the name in files and on the command line
  std::string_view label;  ///< the name in the window
  std::string_view hint;   ///< a description in one sentence
};

/// Returns the choices in the order of the enumeration. Each enumeration must overload this function.
template <class Value>
std::span<const Choice> choices(Value) = delete;

template <class Value>
const Choice& entry_of(Value value) {
  return choices(value)[static_cast<std::size_t>(value)];
}

/// Returns all values, in the order of the enumeration.
template <class Value>
std::vector<Value> all_values() {
  std::vector<Value> all(choices(Value{}).size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Value>(i);
  return all;
}

/// Returns the value with this word. If no value has this word, returns nullopt.
template <class Value>
std::optional<Value> value_of_word(std::string_view word) {
  const std::span<const Choice> all = choices(Value{});
  const auto found = std::ranges::find(all, word, &Choice::word);
  if (found == all.end()) return std::nullopt;
  return static_cast<Value>(found - all.begin());
}

/// Returns the next value. After the last value, returns the first.
template <class Value>
Value next_choice(Value value) {
  return static_cast<Value>((static_cast<std::size_t>(value) + 1) % choices(value).size());
}

}  // namespace viete::base
