// Checks messages and errors.
#pragma once

#include <exception>
#include <string>

namespace viete::test {

inline bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Returns the message of the exception that step() throws; empty without an exception.
std::string problem_of(const auto& step) {
  try {
    step();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace viete::test
