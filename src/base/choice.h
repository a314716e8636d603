// What a person chooses from: the values of an enumeration, by number, in words.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace viete::base {

struct Choice {
  std::string_view word;   ///< in files, and in names of commands
  std::string_view label;  ///< in lists
  std::string_view hint;   ///< one sentence
};

/// Of an enumeration: each that is chosen from has its own beside it, in its namespace.
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

/// The one that follows; the first one after the last.
template <class Value>
Value next_choice(Value value) {
  return static_cast<Value>((static_cast<std::size_t>(value) + 1) % choices(value).size());
}

}  // namespace viete::base
