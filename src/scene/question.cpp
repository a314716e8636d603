#include "scene/question.h"

#include "scene/workspace.h"

namespace viete::scene {

namespace {

using Kind = Question::Kind;

std::string name_of_work(const Workspace& w) {
  return (w.saved.session.empty() ? w.document.model.path : w.saved.session).filename().string();
}

std::string title_before(const Workspace& w, Kind kind) {
  return "Save the edits of " + name_of_work(w) + (kind == Kind::open ? " first?" : "?");
}

}  // namespace

Question ask_before_closing(const Workspace& w, const std::string& why) {
  return {Kind::close, title_before(w, Kind::close),
          "Unsaved edits wait for the next start, but these could not be kept:", why};
}

Question ask_before_opening(const Workspace& w, const std::string& why) {
  return {Kind::open, title_before(w, Kind::open),
          "What is opened takes their place, and they could not be set aside:", why};
}

Question ask_before_replacing(const std::filesystem::path& session) {
  return {
      Kind::replace, session.filename().string() + " has changed on disk",
      "Another window or program has written it since it was opened here. Saving would replace what is there "
      "now.",
      ""};
}

Question ask_after_failed_save(const Workspace& w, Kind kind, const std::string& why) {
  return {kind, title_before(w, kind), "They are not saved yet:", why};
}

const char* label(Kind kind, Answer answer) {
  switch (answer) {
    case Answer::save: return kind == Kind::replace ? "Save as" : "Save";
    case Answer::cancel: return "Cancel";
    case Answer::go_on: break;
  }
  switch (kind) {
    case Kind::close: return "Close without saving";
    case Kind::open: return "Open without saving";
    case Kind::replace: break;
  }
  return "Save anyway";
}

}  // namespace viete::scene
