// Messages to the user, newest last.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace viete::workspace {

enum class Severity { info, warning, error };

/// The object that a message is about. The message is removed when this object changes.
enum class Scope { program, model, cage };

struct Concern {
  std::string_view topic{};  ///< the action, such as "export"; empty: cannot be retried
  Scope scope = Scope::program;
};

struct Message {
  Severity severity = Severity::info;
  std::string text;
  int times = 1;  ///< consecutive repetitions
  std::string topic;
  Scope scope = Scope::program;
  double said = 0;        ///< time of the last repetition, wall clock in seconds
  unsigned revision = 0;  ///< revision of the list after this message
  bool visible = true;    ///< shown over the view; false: only in the message list
};

/// The last 200 messages. Repeating a visible message or the last message only increases its count. Infos and
/// warnings are visible for a limited time, errors until the same action succeeds or the user dismisses them.
class Messages {
public:
  static constexpr double info_seconds = 4, warning_seconds = 12;

  void say(Severity severity, std::string text, Concern concern = {});
  void info(std::string text, Concern concern = {}) { say(Severity::info, std::move(text), concern); }
  void warn(std::string text, Concern concern = {}) { say(Severity::warning, std::move(text), concern); }
  void error(std::string text, Concern concern = {}) { say(Severity::error, std::move(text), concern); }
  /// Adds a message that is visible only in the message list.
  void log(Severity severity, std::string text);
  void clear() { all_.clear(); }

  /// Hides errors of this topic.
  void succeeded(std::string_view topic);
  /// Hides infos and warnings, after undo and redo.
  void hide_messages();
  void dismiss(std::size_t index) { all_[index].visible = false; }
  /// Removes messages about a changed model or cage, up to this revision.
  void forget(Scope scope, unsigned revision);
  /// True if the time of a visible message has ended.
  bool due(double now) const;
  void expire(double now);

  const std::vector<Message>& all() const { return all_; }
  /// Increases with each message, even if it is repeated.
  unsigned revision() const { return revision_; }

private:
  std::vector<Message> all_;
  unsigned revision_ = 0;
};

}  // namespace viete::workspace
