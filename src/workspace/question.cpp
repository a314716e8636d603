#include "workspace/question.h"

namespace viete::workspace {

namespace {

using Asked = Question::Kind;

std::string title_before(const std::string& work, Asked kind) {
  return "Save the edits of " + work + (kind == Asked::open ? " first?" : "?");
}

}  // namespace

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
  return kind <= Asked::replace ? 3 : 2;
}

const char* label(Asked kind, Answer answer) {
  if (answer == Answer::cancel) return "Cancel";
  const bool saves = answer == Answer::save;
  switch (kind) {
    case Asked::close: return saves ? "Save" : "Close without saving";
    case Asked::open: return saves ? "Save" : "Open without saving";
    case Asked::replace: return saves ? "Save as" : "Save anyway";
    case Asked::locate_model:
    case Asked::locate_cage: return "Locate file...";
    case Asked::fins: return "Remove fins";
    case Asked::discard: break;
  }
  return "Delete";
}

}  // namespace viete::workspace
