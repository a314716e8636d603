// Checks of messages and errors.
#pragma once

#include <exception>
#include <string>

namespace viete::test {

inline bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The message of the exception that step() throws, or an empty text.
std::string problem_of(const auto& step) {
  try {
    step();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace viete::test
