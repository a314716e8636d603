// All that was said, newest first: a window over the view.
#include <algorithm>

#include "ui/imgui_bridge.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

const char* word_of(scene::Severity severity) {
  switch (severity) {
    case scene::Severity::error: return "Error: ";
    case scene::Severity::warning: return "Note: ";
    case scene::Severity::info: break;
  }
  return "";
}

}  // namespace

ImU32 severity_color(const Context& ui, scene::Severity severity) {
  switch (severity) {
    case scene::Severity::error: return ui.colors.bad;
    case scene::Severity::warning: return ui.colors.warn;
    case scene::Severity::info: break;
  }
  return ui.colors.text;
}

std::string message_text(const scene::Message& message) {
  const std::string times = message.times > 1 ? "  (" + std::to_string(message.times) + " times)" : "";
  return word_of(message.severity) + message.text + times;
}

void message_log(const Context& ui) {
  scene::Workspace& w = ui.workspace;
  if (!w.show_messages) return;
  const scene::Viewport& v = w.viewport;
  bool open = true;
  const ImVec2 size{std::min(560.0f, v.window.x - 32), std::min(360.0f, v.size.y - 32)};
  const Window window("Messages", {.at = middle_of_view(ui), .size = size}, dialog_flags, &open);
  const auto& all = w.messages.all();
  ImGui::BeginChild("list", {0, -(ImGui::GetFrameHeight() + 8)});
  if (all.empty()) note(ui, "Nothing was said.");
  for (std::size_t i = all.size(); i-- > 0;) {
    note(ui, message_text(all[i]), severity_color(ui, all[i].severity));
    record(ui, "message/" + std::to_string(all.size() - 1 - i));
    if (ImGui::IsItemClicked()) ImGui::SetClipboardText(all[i].text.c_str());
    hint("Click to copy it.");
  }
  ImGui::EndChild();
  if (ImGui::Button("Clear")) w.messages.clear();
  record(ui, "clear_messages");
  hint("Remove these messages.");
  ImGui::SameLine();
  if (ImGui::Button("Close") || key_pressed(scene::Key::escape)) open = false;
  record(ui, "close_messages");
  w.show_messages = open;
}

}  // namespace viete::ui
