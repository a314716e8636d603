// Another program that is run.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace viete::base {

/// It reads nothing; its standard output is thrown away, its standard error kept to be said. Ctrl+C in a
/// terminal does not reach it: who runs it ends it. One thread at a time.
class ChildProgram {
public:
  /// words: the program, looked for in PATH, and its arguments, as they are: no shell. variables:
  /// "NAME=value", beside those of this program. Throws Error where it is not installed, with this advice, or
  /// cannot be run.
  ChildProgram(const std::vector<std::string>& words, const std::string& advice,
               const std::vector<std::string>& variables = {});
  /// One that still runs is killed, with what it has started.
  ~ChildProgram();
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  /// Of its standard error the first 4 KB, so far.
  std::string said() const;
  /// False once it has ended: finish() says how.
  bool running();
  /// Asks it to end, by SIGTERM.
  void stop();
  /// Waits for its end. Throws Error where that is no success, with what it has said.
  void finish();

private:
  [[noreturn]] void fail();
  std::string name_;
  int process_ = 0, errors_ = -1;
  std::optional<int> status_;  // once it has ended
};

}  // namespace viete::base
