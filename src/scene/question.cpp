#include "scene/question.h"

#include "scene/workspace.h"

namespace viete::scene {

namespace {

using Asked = Question::Kind;

std::string name_of_work(const Workspace& w) {
  return (w.saved.session.empty() ? w.document.model.path : w.saved.session).filename().string();
}

std::string title_before(const Workspace& w, Asked kind) {
  return "Save the edits of " + name_of_work(w) + (kind == Asked::open ? " first?" : "?");
}

}  // namespace

Question ask_before_closing(const Workspace& w, const std::string& why) {
  return {Asked::close, title_before(w, Asked::close),
          "Unsaved edits wait for the next start, but these could not be kept:", why};
}

Question ask_before_opening(const Workspace& w, const std::string& why) {
  return {Asked::open, title_before(w, Asked::open),
          "What is opened takes their place, and they could not be set aside:", why};
}

Question ask_before_replacing(const std::filesystem::path& session) {
  return {
      Asked::replace, session.filename().string() + " has changed on disk",
      "Another window or program has written it since it was opened here. Saving would replace what is there "
      "now.",
      ""};
}

Question ask_after_failed_save(const Workspace& w, Asked kind, const std::string& why) {
  return {kind, title_before(w, kind), "They are not saved yet:", why};
}

const char* label(Asked kind, Answer answer) {
  switch (answer) {
    case Answer::save: return kind == Asked::replace ? "Save as" : "Save";
    case Answer::cancel: return "Cancel";
    case Answer::go_on: break;
  }
  switch (kind) {
    case Asked::close: return "Close without saving";
    case Asked::open: return "Open without saving";
    case Asked::replace: break;
  }
  return "Save anyway";
}

}  // namespace viete::scene
