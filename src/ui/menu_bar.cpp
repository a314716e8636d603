// The menu bar and the context menu: commands in their groups.
#include <algorithm>
#include <cctype>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "document/record.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/command_conditions.h"
#include "workspace/menus.h"

namespace viete::ui {

namespace {

bool is_shown(const Context& ui, const workspace::Command& command) {
  return !command.passing || command.enabled(ui.workspace);
}

std::string capitalised(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

// Lists the last edits, newest first. The current edit is marked; a click goes to another edit.
void history_menu(const Context& ui) {
  constexpr std::size_t most = 50;
  workspace::Workspace& w = ui.workspace;
  const std::vector<std::string> labels = w.document.history().labels();
  const std::size_t position = w.document.history().position();
  const bool open = ImGui::BeginMenu("History", !labels.empty() && !workspace::is_dragging(w));
  record(ui, "menu/history");
  if (!open) return;
  std::size_t wanted = position;
  const std::size_t last = labels.size() > most ? std::min(position, labels.size() - most) : 0;
  for (std::size_t n = labels.size() + 1; n-- > last;) {  // state after n edits
    const std::string label = n == 0 ? "Before the first edit" : capitalised(labels[n - 1]);
    if (ImGui::MenuItem((label + "##" + std::to_string(n)).c_str(), nullptr, n == position)) wanted = n;
    record(ui, "history/" + std::to_string(n));
  }
  ImGui::EndMenu();
  if (wanted == position) return;
  document::go_to_edit(w.document, wanted);
  w.view.interaction.hovered.reset();
}

void recent_menu(const Context& ui) {
  workspace::Workspace& w = ui.workspace;
  const bool open = ImGui::BeginMenu("Open recent", !w.preferences.recent.empty());
  record(ui, "menu/recent");
  if (!open) return;
  std::optional<std::size_t> chosen;
  for (std::size_t i = 0; i < w.preferences.recent.size(); ++i) {
    const workspace::RecentFile& recent = w.preferences.recent[i];
    const std::string name = recent.file.filename().string() + "##" + std::to_string(i);
    const std::string folder = shortened(recent.file.parent_path().filename().string(), 160);
    if (ImGui::MenuItem(name.c_str(), folder.c_str())) chosen = i;
    record(ui, "menu/recent/" + std::to_string(i));
    hint(place_of(recent));
  }
  ImGui::EndMenu();
  if (chosen) open_recent(w, *chosen);
}

// Adds the list of recent files after the command Open, and the history after the command Redo.
void list_behind(const Context& ui, const workspace::Command& command) {
  if (command.name == "open_model") recent_menu(ui);
  if (command.name == "redo") history_menu(ui);
}

// Consecutive commands of the same choice are in one submenu.
void items(const Context& ui, const workspace::Menu& menu) {
  std::string_view submenu, group = menu.items.empty() ? "" : menu.items.front()->group;
  bool open = false, line = false, any = false;
  for (const workspace::Command* command : menu.items) {
    line |= workspace::begins_section(*command) || command->group != group;
    group = command->group;
    if (!is_shown(ui, *command)) continue;
    const std::string_view title = command->submenu;
    if (title != submenu) {
      if (open) ImGui::EndMenu();
      if (std::exchange(line, false) && any) ImGui::Separator();
      open = !title.empty() && ImGui::BeginMenu(std::string(title).c_str());
      if (!title.empty()) record(ui, "menu/" + std::string(title));
      submenu = title;
    }
    if (submenu.empty() && std::exchange(line, false) && any) ImGui::Separator();
    any = true;
    if (submenu.empty() || open) menu_item(ui, *command, submenu.empty() ? "" : command->brief);
    if (submenu.empty()) list_behind(ui, *command);
  }
  if (open) ImGui::EndMenu();
}

// Commands of the context menu, in order; | is a separator. Disabled commands are omitted.
constexpr const char* offers =
    "undo redo | reset_selected | frame_selection frame_all | select_all select_none invert_selection "
    "select_linked | split_edges cut_faces extrude_faces merge_vertices remove_elements | make_cage "
    "edit_cage | toggle_pulls toggle_locked mirror_probe remove_probe "
    "| set_key keep_pose | add_probe | command_palette";

}  // namespace

bool menu_item(const Context& ui, const workspace::Command& command, std::string_view called) {
  const bool enabled = command.enabled(ui.workspace);
  const bool on = command.on(ui.workspace);
  const std::string label = command.label_now(ui.workspace, called.empty() ? command.label : called) + "##" +
                            std::string(command.name);
  const std::string keys = workspace::text(ui.workspace.preferences.keymap.of(command).first);
  const bool chosen = ImGui::MenuItem(label.c_str(), keys.c_str(), on, enabled);
  record(ui, "menu/" + std::string(command.name), enabled);
  hint(hint_of(ui, command));
  if (chosen) command.run(ui.workspace);
  return chosen;
}

void menu_bar(const Context& ui) {
  constexpr float height = workspace::PanelLayout::menu_height;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {8, 0.5f * (height - ImGui::GetFontSize())});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  const bool open = ImGui::BeginMainMenuBar();
  ImGui::PopStyleVar(2);
  if (!open) return;
  for (const workspace::Menu& menu : workspace::menus()) {
    const bool shown = ImGui::BeginMenu(std::string(menu.title).c_str());
    record(ui, "menu/" + std::string(menu.title));
    if (!shown) continue;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8, 8});
    items(ui, menu);
    ImGui::PopStyleVar();
    ImGui::EndMenu();
  }
  const float line = ImGui::GetWindowPos().y + height - 1;
  ImGui::GetWindowDrawList()->AddLine({0, line}, {ui.workspace.view.viewport.window.x, line}, ui.colors.line);
  ImGui::EndMainMenuBar();
}

void command_menu(const Context& ui, const char* name, std::initializer_list<std::string_view> commands) {
  if (!ImGui::BeginPopup(name)) return;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8, 8});
  for (const std::string_view command : commands) menu_item(ui, *workspace::find_command(command));
  ImGui::PopStyleVar();
  ImGui::EndPopup();
}

void context_menu(const Context& ui) {
  auto& asked = ui.workspace.view.interaction.menu;
  if (asked) {
    ImGui::OpenPopup("Context");  // at the mouse, within the window
    ui.workspace.view.interaction.menu_at = *asked;
    asked.reset();
  }
  if (!ImGui::BeginPopup("Context")) return;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8, 8});
  bool line = false, any = false, chosen = false;
  auto& w = ui.workspace;
  const auto cursor =
      std::exchange(w.view.interaction.cursor, w.view.interaction.menu_at);  // commands act at this place
  std::istringstream words(offers);
  for (std::string offer; words >> offer;) {
    const workspace::Command* command = workspace::find_command(offer);
    line |= !command;
    if (!command || !command->enabled(w)) continue;
    if (line && any) ImGui::Separator();
    line = false;
    any = true;
    if (menu_item(ui, *command)) chosen = true;
  }
  if (!chosen) w.view.interaction.cursor = cursor;
  ImGui::PopStyleVar();
  ImGui::EndPopup();
}

}  // namespace viete::ui
