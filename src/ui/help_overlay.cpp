#include "scene/commands.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

struct MouseLine {
  const char* action;
  const char* what;
};

constexpr MouseLine mouse_lines[] = {
    {"Left click", "select a vertex, edge or face (Shift adds, Ctrl removes)"},
    {"Left drag on it", "move the selection (a face: once it is selected)"},
    {"Left drag elsewhere", "select with a box (Shift adds, Ctrl removes)"},
    {"Left drag on a handle", "move, rotate or scale along what it points at"},
    {"Ctrl, Shift while dragging", "snap to steps; go a tenth of the way"},
    {"X Y Z, digits, Enter", "while dragging: axis (Shift: plane), amount, done"},
    {"Middle, right or Alt+left drag", "orbit; with Shift pan, with Ctrl zoom"},
    {"Wheel", "zoom to the cursor"},
    {"Esc or right button", "during a drag: everything as it was"},
};

void line(const Context& ui, const char* left, const char* right) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(left);
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, ui.colors.faint);
  ImGui::TextUnformatted(right);
  ImGui::PopStyleColor();
}

void heading(const Context& ui, const std::string& text) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::Spacing();
  ImGui::PushFont(ui.fonts.strong);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopFont();
  ImGui::TableNextColumn();
}

std::string keys_of(const scene::Command& command) {
  const std::string also = scene::text(command.alternative);
  return scene::text(command.shortcut) + (also.empty() ? "" : ", " + also);
}

void group_lines(const Context& ui, std::string_view group) {
  heading(ui, std::string(group));
  for (const auto& command : scene::commands()) {
    if (command.group != group || command.shortcut.key == scene::Key::none) continue;
    line(ui, keys_of(command).c_str(), std::string(command.hint).c_str());
  }
}

void about(const Context& ui) {
  const scene::About& about = ui.workspace.about;
  heading(ui, "About");
  line(ui, "Viete", (about.version + ", " + about.build).c_str());
  line(ui, "Kernel", about.kernel.c_str());
  line(ui, "OpenGL", about.renderer.c_str());
}

template <class Lines>
void column(const char* name, Lines lines) {
  ImGui::BeginGroup();
  if (ImGui::BeginTable(name, 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoHostExtendX)) {
    lines();
    ImGui::EndTable();
  }
  ImGui::EndGroup();
}

}  // namespace

void help_overlay(const Context& ui) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  constexpr float widest = 1080;
  const float left = ui.workspace.view.panels && display.x > column_width + widest ? column_width : 0;
  ImGui::SetNextWindowPos({left + 0.5f * (display.x - left), 0.5f * (display.y - status_height)}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({420, 0}, {display.x - 40, display.y - 60});
  bool open = true;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8);
  ImGui::Begin("Keys and mouse", &open, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize);
  column("left", [&] {
    heading(ui, "Mouse");
    for (const auto& entry : mouse_lines) line(ui, entry.action, entry.what);
    for (const char* group : {"File", "Edit", "Select"}) group_lines(ui, group);
  });
  ImGui::SameLine(0, 32);
  column("right", [&] {
    for (const char* group : {"Tool", "Method", "View"}) group_lines(ui, group);
    about(ui);
  });
  ImGui::End();
  ImGui::PopStyleVar();
  if (!open) ui.workspace.view.help = false;
}

}  // namespace viete::ui
