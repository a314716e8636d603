// An exception with place, problem and advice.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace viete::base {

/// An expected failure, such as bad input or a full disk. what() is a line `place: problem; advice`. Example:
/// `dragon.obj:1042: face refers to vertex 70000, the file has 50000; export the model again`.
class Error : public std::runtime_error {
public:
  /// `place` is a file, `file:line` or `file: element 12`. `advice` is an instruction. Both may be empty.
  Error(std::string place, std::string problem, std::string advice = "");

  const std::string& place() const { return place_; }
  const std::string& problem() const { return problem_; }
  const std::string& advice() const { return advice_; }

private:
  std::string place_, problem_, advice_;
};

/// Returns the message of an exception for the user. For a failed allocation, what() is not a message.
std::string message_of(const std::exception& error);

}  // namespace viete::base
