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
  double said = 0;        ///< time of the last one, wall clock in seconds
  unsigned revision = 0;  ///< revision of the list after this message
  bool visible = true;    ///< shown over the view; false: only in the message list
};

/// Keeps the last 200. A repetition of a visible message, or of the last one, increases its count. A message
/// is visible for a limited time, an error until the same action succeeds or the user dismisses it.
class Messages {
public:
  static constexpr double info_seconds = 4, warning_seconds = 12;

  void say(Severity severity, std::string text, Concern concern = {});
  void info(std::string text, Concern concern = {}) { say(Severity::info, std::move(text), concern); }
  void warn(std::string text, Concern concern = {}) { say(Severity::warning, std::move(text), concern); }
  void error(std::string text, Concern concern = {}) { say(Severity::error, std::move(text), concern); }
  /// Adds it to the message list only.
  void log(Severity severity, std::string text);
  void clear() { all_.clear(); }

  /// Hides errors of this topic.
  void succeeded(std::string_view topic);
  /// After undo and redo: hides infos and warnings.
  void hide_messages();
  void dismiss(std::size_t index) { all_[index].visible = false; }
  /// After a change of the model or the cage: removes messages about it up to this revision.
  void forget(Scope scope, unsigned revision);
  /// True if the time of a visible message has ended.
  bool due(double now) const;
  void expire(double now);

  const std::vector<Message>& all() const { return all_; }
  /// Increases with each message, also a repeated one.
  unsigned revision() const { return revision_; }

private:
  std::vector<Message> all_;
  unsigned revision_ = 0;
};

}  // namespace viete::workspace
