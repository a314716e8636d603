// Runs another program.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace viete::base {

/// A child process without input; its standard output is discarded, its standard error is kept for messages.
/// Ctrl+C in a terminal does not reach it; the caller must end it. Use from one thread at a time.
class ChildProgram {
public:
  /// words: the program, searched in PATH, and its arguments, passed without a shell. variables:
  /// "NAME=value", in addition to the environment of this program. Throws Error if the program is not
  /// installed, with this advice, or cannot be run.
  ChildProgram(const std::vector<std::string>& words, const std::string& advice,
               const std::vector<std::string>& variables = {});
  /// Kills the program, with its own children, if it is still running.
  ~ChildProgram();
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  /// The first 4 KB of its standard error, so far.
  std::string said() const;
  /// False once it has ended; finish() reports how.
  bool running();
  /// Asks it to end by SIGTERM.
  void stop();
  /// Waits for its end. Throws Error with its standard error if it failed.
  void finish();

private:
  [[noreturn]] void fail();
  std::string name_;
  int process_ = 0, errors_ = -1;
  std::optional<int> status_;  // set once it has ended
};

}  // namespace viete::base
