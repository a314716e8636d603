// Runs another program as a child process.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace viete::base {

/// A child process. Its standard input is empty, and its standard output is discarded. Its standard error is
/// used in messages. Ctrl+C in a terminal does not end the process. Not thread-safe.
class ChildProgram {
public:
  /// Starts the program words[0], found in PATH, with the other words as arguments. Adds `variables`
  /// ("NAME=value") to the environment. If the program is not installed or cannot run, throws Error, usually
  /// with `advice`.
  ChildProgram(const std::vector<std::string>& words, const std::string& advice,
               const std::vector<std::string>& variables = {});
  /// Kills the program and its children.
  ~ChildProgram();
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  /// Returns the first 4 KB of the program's standard error.
  std::string said() const;
  bool running();
  /// Sends SIGTERM to the program.
  void stop();
  /// Waits until the program ends. If the program failed, throws Error with its standard error.
  void finish();

private:
  [[noreturn]] void fail();
  std::string name_;
  int process_ = 0, errors_ = -1;
  std::optional<int> status_;  // set after the program ended
};

}  // namespace viete::base
