#include "ui/panels.h"

#include <imgui_internal.h>

#include <string>

namespace viete::ui {

namespace {

using Characters = std::set<char32_t>;

// Adds the characters after Latin-1, which the fonts always have.
void add(Characters& all, const std::string& text) {
  for (const char *at = text.data(), *end = at + text.size(); at < end;) {
    unsigned character = static_cast<unsigned char>(*at);
    at += character < 0x80 ? 1 : ImTextCharFromUtf8(&character, at, end);
    if (character > 0xff && character <= IM_UNICODE_CODEPOINT_MAX &&
        character != IM_UNICODE_CODEPOINT_INVALID)
      all.insert(character);
  }
}

template <class List, class Text>
void add_each(Characters& all, const List& list, Text text) {
  for (const auto& entry : list) add(all, entry.*text);
}

void add_files(Characters& all, const workspace::Workspace& w) {
  add(all, w.document.model().path.string());
  add(all, w.document.cage_file().path.string());
  add(all, w.document.cage_beside().string());
  add(all, w.files.saved.session.string());
  for (const workspace::RecentFile& recent : w.preferences.recent) {
    add(all, recent.file.string());
    add(all, recent.cage.string());
  }
  for (const files::RecoveryFile& kept : w.recovery.files) {
    add(all, kept.name);
    add(all, kept.folder.string());
  }
}

void add_browser(Characters& all, const workspace::FileBrowser& browser) {
  if (!browser.open) return;
  add_each(all, browser.entries, &workspace::FileBrowser::Entry::name);
  add(all, browser.folder.string());
  for (const std::string* text : {&browser.path, &browser.problem, &browser.filter, &browser.warned})
    add(all, *text);
}

}  // namespace

std::set<char32_t> shown_characters(const workspace::Workspace& w) {
  Characters all;
  add_files(all, w);
  add_browser(all, w.files.browser);
  add_each(all, w.document.library().poses, &document::NamedPose::name);
  add_each(all, w.document.groups().sets, &document::NamedSet::name);
  add_each(all, w.messages.all(), &workspace::Message::text);
  for (const auto* work : {&w.jobs.loading, &w.jobs.binding, &w.jobs.exporting}) add(all, work->what);
  if (const auto& question = w.files.question) {
    for (const std::string* text : {&question->title, &question->text, &question->why}) add(all, *text);
  }
  for (const ImWchar typed : ImGui::GetIO().InputQueueCharacters)
    if (typed > 0xff) all.insert(typed);
  return all;
}

}  // namespace viete::ui
