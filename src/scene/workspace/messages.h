// What the program has to say to the user, newest last.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace viete::scene {

enum class Severity { info, warning, error };

/// Whose end a message does not outlive.
enum class Scope { program, model, cage };

struct Concern {
  std::string_view topic{};  ///< what was tried: "export"; empty: nothing that could go well another time
  Scope scope = Scope::program;
};

struct Message {
  Severity severity = Severity::info;
  std::string text;
  int times = 1;  ///< said this often in a row
  std::string topic;
  Scope scope = Scope::program;
  double said = 0;        ///< last, in seconds of wall time
  unsigned revision = 0;  ///< of the messages, with this one
  bool in_sight = true;   ///< over the view; else in the list of all alone
};

/// Keeps the last 200. A message that repeats one in sight, or the last one, is counted, not listed again.
/// Each is in sight for a while; an error until the same thing has succeeded, or it is dismissed.
class Messages {
public:
  static constexpr double info_seconds = 4, warning_seconds = 12;

  void say(Severity severity, std::string text, Concern concern = {});
  void info(std::string text, Concern concern = {}) { say(Severity::info, std::move(text), concern); }
  void warn(std::string text, Concern concern = {}) { say(Severity::warning, std::move(text), concern); }
  void error(std::string text, Concern concern = {}) { say(Severity::error, std::move(text), concern); }
  /// Only in the list of all.
  void log(Severity severity, std::string text);
  void clear() { all_.clear(); }

  /// Errors of this topic are history.
  void succeeded(std::string_view topic);
  /// An edit was undone or redone: infos and warnings on it are history.
  void leave_sight();
  void dismiss(std::size_t index) { all_[index].in_sight = false; }
  /// The model, or the cage, is another one: what was said of it, up to this revision, goes.
  void forget(Scope scope, unsigned revision);
  /// True if the time in sight of some has come to its end.
  bool due(double now) const;
  void expire(double now);

  const std::vector<Message>& all() const { return all_; }
  /// Grows with each message, also a repeated one.
  unsigned revision() const { return revision_; }

private:
  std::vector<Message> all_;
  unsigned revision_ = 0;
};

}  // namespace viete::scene
