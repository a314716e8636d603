// The error type of readers, the deformer and the commands: problem, place, and advice.
#pragma once

#include <stdexcept>
#include <string>

namespace viete::base {

/// An expected failure (bad input, a full disk), never a bug. what() is one actionable line, `place: problem;
/// advice`, for example `dragon.obj:1042: face refers to vertex 70000, the file has 50000; export the model
/// again`.
class Error : public std::runtime_error {
public:
  /// place: a file, `file:line` or `file: element 12`; may be empty. advice: an imperative; may be empty.
  Error(std::string place, std::string problem, std::string advice = "");

  const std::string& place() const { return place_; }
  const std::string& problem() const { return problem_; }
  const std::string& advice() const { return advice_; }

private:
  std::string place_, problem_, advice_;
};

}  // namespace viete::base
