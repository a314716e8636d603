// Names and descriptions of the values of an enumeration, for users.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace viete::base {

struct Choice {
  std::string_view word;   ///< name in files and on the command line
  std::string_view label;  ///< name in lists of the window
  std::string_view hint;   ///< description in one sentence
};

/// The choices of an enumeration. Each enumeration has an overload in its namespace.
template <class Value>
std::span<const Choice> choices(Value) = delete;

template <class Value>
const Choice& entry_of(Value value) {
  return choices(value)[static_cast<std::size_t>(value)];
}

/// The value with this word, or nullopt.
template <class Value>
std::optional<Value> value_of_word(std::string_view word) {
  const std::span<const Choice> all = choices(Value{});
  const auto found = std::ranges::find(all, word, &Choice::word);
  if (found == all.end()) return std::nullopt;
  return static_cast<Value>(found - all.begin());
}

/// The next value; the first follows the last.
template <class Value>
Value next_choice(Value value) {
  return static_cast<Value>((static_cast<std::size_t>(value) + 1) % choices(value).size());
}

}  // namespace viete::base
