// What the program has to say to the user, newest last.
#pragma once

#include <string>
#include <vector>

namespace viete::scene {

enum class Severity { info, warning, error };

struct Message {
  Severity severity = Severity::info;
  std::string text;
  int times = 1;  ///< said this often in a row
};

/// Keeps the last 200. A message that repeats the one before it is counted, not listed again.
class Messages {
public:
  void say(Severity severity, std::string text);
  void info(std::string text) { say(Severity::info, std::move(text)); }
  void warn(std::string text) { say(Severity::warning, std::move(text)); }
  void error(std::string text) { say(Severity::error, std::move(text)); }
  void clear() { all_.clear(); }

  const std::vector<Message>& all() const { return all_; }
  /// Grows with each message, also a repeated one.
  unsigned revision() const { return revision_; }

private:
  std::vector<Message> all_;
  unsigned revision_ = 0;
};

}  // namespace viete::scene
