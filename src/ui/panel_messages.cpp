#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

ImU32 color_of(const Context& ui, scene::Severity severity) {
  switch (severity) {
    case scene::Severity::error: return ui.colors.bad;
    case scene::Severity::warning: return ui.colors.warn;
    case scene::Severity::info: break;
  }
  return ui.colors.faint;
}

const char* word_of(scene::Severity severity) {
  switch (severity) {
    case scene::Severity::error: return "Error: ";
    case scene::Severity::warning: return "Note: ";
    case scene::Severity::info: break;
  }
  return "";
}

}  // namespace

// At the top of the column, where it is seen; nothing at all when there is nothing to say.
void panel_messages(const Context& ui) {
  auto& messages = ui.workspace.messages;
  if (messages.all().empty() || !section(ui, "Messages")) return;
  const std::size_t n = messages.all().size();
  const std::size_t first = n > 5 ? n - 5 : 0;
  for (std::size_t i = n; i-- > first;) {
    const auto& message = messages.all()[i];
    const std::string times = message.times > 1 ? "  (" + std::to_string(message.times) + " times)" : "";
    note(ui, word_of(message.severity) + message.text + times, color_of(ui, message.severity));
  }
  if (first > 0) note(ui, "and " + std::to_string(first) + " earlier");
  if (ImGui::Button("Clear##messages")) messages.clear();
  record(ui, "clear_messages");
  hint("Remove these messages.");
}

}  // namespace viete::ui
