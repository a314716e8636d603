// Messages and questions to the user.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace viete::workspace {

enum class Severity { info, warning, error };

/// The object that a message is about. When the model or cage changes, its messages are removed.
enum class Scope { program, model, cage };

struct Concern {
  std::string_view topic{};  ///< the action, such as "export", for succeeded(); may be empty
  Scope scope = Scope::program;
};

struct Message {
  Severity severity = Severity::info;
  std::string text;
  int times = 1;  ///< number of times that this message was added
  std::string topic;
  Scope scope = Scope::program;
  double said = 0;        ///< time of the last repetition, wall clock in seconds
  unsigned revision = 0;  ///< revision of the list after this message
  bool visible = true;    ///< shown over the view; false: only in the message list
};

/// The last 200 messages. Repeating a visible message or the last message only increases its count. Infos and
/// warnings are visible for a limited time, errors until the action succeeds or the user dismisses the error.
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
  /// Hides infos and warnings. Called after undo and redo.
  void hide_messages();
  void dismiss(std::size_t index) { all_[index].visible = false; }
  /// Scope::cage: removes messages about the cage. Scope::model: also removes messages about the model. Keeps
  /// messages that were added after this revision.
  void forget(Scope scope, unsigned revision);
  /// The time at which the next message must be hidden, on the wall clock in seconds; or base::never.
  double next_end() const;
  void expire(double now);

  const std::vector<Message>& all() const { return all_; }
  /// Increases with each message, also with a repeated message.
  unsigned revision() const { return revision_; }

private:
  std::vector<Message> all_;
  unsigned revision_ = 0;
};

enum class Answer { save, cancel, proceed };

/// A question to the user before edits or files are lost.
struct Question {
  enum class Kind {
    close,         ///< closing the program, if unsaved edits could not be backed up
    open,          ///< opening another document, if unsaved edits could not be backed up
    replace,       ///< overwriting a session that changed on disk
    moved,         ///< saving a session whose model or cage was moved or deleted
    locate_model,  ///< the model of a session is missing
    locate_cage,   ///< the cage of a session is missing
    fins,          ///< opening a cage with fins (surfaces with the outside on both sides)
    discard        ///< deleting recovered edits
  };
  Kind kind = Kind::close;
  std::string title, text;
  std::string why;         ///< the reported cause; may be empty
  std::size_t chosen = 0;  ///< index of the answer that Enter gives; at first a safe answer
};

/// `work` is the name of the unsaved work, see name_of_work().
Question ask_before_closing(const std::string& work, const std::string& why);
Question ask_before_opening(const std::string& work, const std::string& why);
Question ask_before_replacing(const std::filesystem::path& session);
/// `names` are the names of the missing files.
Question ask_to_save_meshes(const std::string& names);
Question ask_after_failed_save(const std::string& work, Question::Kind kind, const std::string& why);

/// `key` must be "model" or "cage".
Question ask_to_locate(std::string_view key, const std::string& problem);
Question ask_to_remove_fins(const std::string& problem);
Question ask_before_discarding(std::size_t count);

/// The number of answers of a question: 2 (Answer::save and Answer::cancel) or 3.
std::size_t answer_count(Question::Kind kind);
/// The caption of an answer's button.
const char* label(Question::Kind kind, Answer answer);

}  // namespace viete::workspace
