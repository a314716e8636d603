#include "workspace/messages.h"

#include <algorithm>
#include <utility>

#include "base/clock.h"
#include "base/text.h"

namespace viete::workspace {

namespace {

// The time at which the message is hidden.
double end_of(const Message& message) {
  if (!message.visible || message.severity == Severity::error) return base::never;
  const bool info = message.severity == Severity::info;
  return message.said + (info ? Messages::info_seconds : Messages::warning_seconds);
}

using Asked = Question::Kind;

std::string title_before(const std::string& work, Asked kind) {
  return "Save the edits of " + work + (kind == Asked::open ? " first?" : "?");
}

}  // namespace

void Messages::say(Severity severity, std::string text, Concern concern) {
  ++revision_;
  text = base::printable(text);
  const auto again = std::ranges::find_if(all_, [&](const Message& m) {
    return (m.visible || &m == &all_.back()) && m.severity == severity && m.text == text;
  });
  if (again != all_.end()) {
    std::rotate(again, again + 1, all_.end());
  } else {
    if (all_.size() >= 200) all_.erase(all_.begin());
    all_.push_back(
        {severity, std::move(text), 0, std::string(concern.topic), concern.scope, 0, revision_, true});
  }
  Message& message = all_.back();
  ++message.times;
  message.said = base::wall_seconds();
  message.revision = revision_;
  message.visible = true;
}

void Messages::log(Severity severity, std::string text) {
  say(severity, std::move(text));
  all_.back().visible = false;
}

void Messages::succeeded(std::string_view topic) {
  for (Message& message : all_) {
    if (message.severity == Severity::error && message.topic == topic) message.visible = false;
  }
}

void Messages::hide_messages() {
  for (Message& message : all_) message.visible &= message.severity == Severity::error;
}

void Messages::forget(Scope scope, unsigned revision) {
  std::erase_if(all_, [&](const Message& m) { return m.scope >= scope && m.revision <= revision; });
}

double Messages::next_end() const {
  double next = base::never;
  for (const Message& message : all_) next = std::min(next, end_of(message));
  return next;
}

void Messages::expire(double now) {
  for (Message& message : all_) {
    if (end_of(message) <= now) message.visible = false;
  }
}

Question ask_before_closing(const std::string& work, const std::string& why) {
  return {Asked::close, title_before(work, Asked::close),
          "These edits could not be saved for recovery:", why};
}

Question ask_before_opening(const std::string& work, const std::string& why) {
  return {Asked::open, title_before(work, Asked::open),
          "Opening replaces these edits, and they could not be saved for recovery:", why};
}

Question ask_before_replacing(const std::filesystem::path& session) {
  return {
      Asked::replace, session.filename().string() + " has changed on disk",
      "Another window or program changed the file after it was opened here. Saving replaces that version.",
      ""};
}

Question ask_to_save_meshes(const std::string& names) {
  return {Asked::moved,
          names + (names.find(" and ") == std::string::npos ? " was" : " were") + " moved or deleted",
          "A session refers to the files of its meshes. They are still open here and can be saved beside the "
          "session.",
          ""};
}

Question ask_after_failed_save(const std::string& work, Asked kind, const std::string& why) {
  return {kind, title_before(work, kind), "Saving failed:", why};
}

Question ask_to_locate(std::string_view key, const std::string& problem) {
  return {key == "model" ? Asked::locate_model : Asked::locate_cage,
          "The " + std::string(key) + " of this session was not found",
          "The file may have been moved or renamed. Locate it to open the session:", problem};
}

Question ask_to_remove_fins(const std::string& problem) {
  return {Asked::fins, "Open the cage without its fins?",
          "Fins are faces that stick out. Viete can remove them and leaves the file unchanged.", problem};
}

Question ask_before_discarding(std::size_t count) {
  return {Asked::discard, "Delete the recovered edits?",
          (count == 1 ? "They are" : "All " + std::to_string(count) + " are") +
              std::string(" in no other file. This cannot be undone."),
          "", 1};
}

std::size_t answer_count(Asked kind) {
  return kind <= Asked::moved ? 3 : 2;
}

const char* label(Asked kind, Answer answer) {
  if (answer == Answer::cancel) return "Cancel";
  const bool saves = answer == Answer::save;
  switch (kind) {
    case Asked::close: return saves ? "Save" : "Close without saving";
    case Asked::open: return saves ? "Save" : "Open without saving";
    case Asked::replace: return saves ? "Save as" : "Save anyway";
    case Asked::moved: return saves ? "Save meshes too" : "Save session only";
    case Asked::locate_model:
    case Asked::locate_cage: return "Locate file...";
    case Asked::fins: return "Remove fins";
    case Asked::discard: break;
  }
  return "Delete";
}

}  // namespace viete::workspace
