// What tests ask of messages.
#pragma once

#include <string>

#include "base/error.h"

namespace viete::test {

inline bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// What is said where a step is refused; empty: it is not.
std::string problem_of(const auto& step) {
  try {
    step();
  } catch (const base::Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace viete::test
