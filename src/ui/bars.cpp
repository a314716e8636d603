// The menu bar, the context menu and the status bar; the texts about mouse actions.
#include <algorithm>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "document/elements.h"
#include "interact/gizmo.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/command_tables.h"

namespace viete::ui {

namespace {

bool is_shown(const Context& ui, const workspace::Command& command) {
  return !command.passing || command.enabled(ui.workspace);
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
    const std::string label = n == 0 ? "Before the first edit" : base::capitalised(labels[n - 1]);
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
  ImGui::GetWindowDrawList()->AddLine({0, line}, {ui.workspace.view.camera.viewport.window.x, line},
                                      ui.colors.line);
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

namespace {

std::string hovered_text(const document::Selection& selection, std::uint32_t element, bool crowded) {
  const std::string name =
      base::capitalised(document::element_name(selection.kind()) + ' ' + std::to_string(element));
  const bool first_click =
      (crowded || selection.kind() == document::ElementKind::face) && !selection.contains(element);
  return name + (first_click ? ":  click selects, drag draws a box" : ":  click selects, drag moves");
}

std::string bend_words(const interact::Constraint& about) {
  if (about.kind == interact::Constraint::Kind::free) return "X Y Z choose the bend axis,  ";
  const std::string axis(1, static_cast<char>('X' + about.axis));
  return "bends about " + axis + " (press " + axis + " again for the view axis),  ";
}

std::string shape_words(const interact::TransformDrag& drag) {
  const interact::Shaping& shaping = drag.grip().shaping;
  const std::string about = shaping.shape == interact::Shape::bend ? bend_words(drag.constraint()) : "";
  return "Type digits or move sideways to set the amount,  " + about +
         "click confirms,  Esc cancels,  Shift slows,  Ctrl snaps";
}

// True if a drag would rotate a whole posed cage. This can change the model's shape: see manual, blending.
bool rotates_posed_cage(const workspace::Workspace& w) {
  const document::Document& d = w.document;
  return w.view.tool == interact::Tool::rotate && d.has_cage() &&
         d.selection().kind() != document::ElementKind::probe && d.deformer().exponential() &&
         d.pose().positions != d.cage()->surface.positions &&
         document::selected_vertices(*d.cage(), d.selection()).size() == d.pose().positions.size();
}

// Removes phrases from the end until the text fits. Two spaces separate the phrases.
std::string fitting(std::string text, float width) {
  while (!text.empty() && ImGui::CalcTextSize(text.c_str()).x > width) {
    const std::size_t end = text.rfind("  ");
    if (end == std::string::npos) return "";
    text.erase(text.find_last_not_of(" ,;:", end) + 1);
  }
  return text;
}

std::string numbers_text(const workspace::Workspace& w) {
  const auto median = w.view.split.views[0].stats.median();
  const std::string frame = median ? milliseconds(median->frame) + " a frame" : "";
  const std::string kernel = w.about.kernel.empty() ? "" : "kernel " + w.about.kernel;
  return frame + (frame.empty() || kernel.empty() ? "" : "   ") + kernel;
}

}  // namespace

std::string mouse_text(const workspace::Workspace& w) {
  const workspace::Keymap& keymap = w.preferences.keymap;
  if (w.view.interaction.drag && w.view.interaction.drag->grip().shaping.shape != interact::Shape::none)
    return shape_words(*w.view.interaction.drag);
  if (w.view.interaction.drag)
    return std::string("X Y Z limit to an axis,  digits set the amount,  ") +
           (w.view.handling.soft.on ? "wheel changes the radius,  " : "") +
           "Ctrl snaps,  Shift slows;  Esc or right button cancels";
  if (w.view.time.hovered)
    return "Drag the ruler to change the frame,  keys to move them,  elsewhere to select;  wheel zooms,  "
           "middle drag pans";
  if (w.view.interaction.grab) return "Move the pointer into the view to start;  Esc cancels";
  if (w.view.interaction.placing_pivot)
    return "Click a vertex, an edge or the model to place the pivot;  Esc cancels";
  if (const std::string selecting = select_hint(w); !selecting.empty()) return selecting;
  if (!w.view.options.deformed)
    return "The model is shown at rest;  " + key_or_label(keymap, "toggle_deformed") +
           " shows the deformation";
  if (w.view.interaction.stroke) return "Release to confirm;  Esc or right button cancels";
  if (workspace::shows_mask(w))
    return "Drag paints vertices that stay at rest,  Ctrl erases;  Shift and wheel change the brush;  middle "
           "or right drag " +
           std::string(keymap.left_orbits() ? "orbits or pans" : "orbits");
  if (w.view.interaction.over_axes) return "Click to view along an axis, drag to orbit";
  if (w.view.interaction.handle && rotates_posed_cage(w))
    return interact::handle_name(w.view.tool, *w.view.interaction.handle) +
           ":  drag.  This changes the model's shape slightly.  To see another side, orbit the camera.";
  if (w.view.interaction.handle)
    return interact::handle_name(w.view.tool, *w.view.interaction.handle) +
           ":  drag;  Ctrl snaps,  Shift slows,  digits set the amount";
  if (w.view.interaction.hovered)
    return hovered_text(w.document.selection(), *w.view.interaction.hovered, w.view.interaction.crowded);
  if (w.document.selection().kind() == document::ElementKind::probe && !w.document.probes().empty())
    return "Drag a probe to move it,  " + empty_space_words(keymap);
  if (w.document.has_cage())
    return "Drag a vertex, edge or selected face to move it,  " + empty_space_words(keymap);
  return base::capitalised(looking_words(keymap));
}

namespace {

void add_looking(const workspace::Keymap& keymap, std::vector<MouseLine>& lines) {
  if (keymap.left_orbits()) {
    lines.push_back({"Middle or Alt+left drag", "orbit; with Shift pan, with Ctrl zoom"});
    lines.push_back({"Right drag", "pan"});
  } else if (keymap.alt_moves_camera()) {
    lines.push_back({"Alt+left, middle, right drag", "orbit, pan, zoom"});
    lines.push_back({"Middle or right drag", "orbit; with Shift pan, with Ctrl zoom"});
  } else {
    lines.push_back({"Middle, right or Alt+left drag", "orbit; with Shift pan, with Ctrl zoom"});
  }
  lines.push_back({"Wheel", "zoom to the cursor"});
  lines.push_back({"Double click", "orbit about this point"});
}

}  // namespace

std::string key_or_label(const workspace::Keymap& keymap, std::string_view name) {
  const workspace::Command& command = *workspace::find_command(name);
  const std::string key = workspace::text(keymap.of(command).first);
  return key.empty() ? '"' + std::string(command.label) + '"' : key;
}

std::vector<MouseLine> mouse_lines(const workspace::Keymap& keymap) {
  std::vector<MouseLine> lines = {
      {"Left click", "select a vertex, edge, face or probe (Shift adds, Ctrl removes)"},
      {"Left drag on an element", "move the selection (click faces and dense vertices first)"}};
  if (keymap.left_orbits()) {
    lines.push_back({"Left drag elsewhere", "orbit, or select with a box after " +
                                                key_or_label(keymap, "select_box") + ", with Shift or Ctrl"});
  } else {
    lines.push_back({"Left drag elsewhere", "box select; with Shift or Ctrl, start anywhere"});
  }
  lines.push_back({"Left drag on a handle", "move, rotate or scale along its axis"});
  lines.push_back({"Ctrl, Shift while dragging", "Ctrl snaps to steps; Shift moves at a tenth of the speed"});
  lines.push_back({"X Y Z while dragging", "move along an axis (Shift: in a plane); type an amount, Enter"});
  lines.push_back({"Esc or right button", "cancel the drag"});
  lines.push_back({"Double click on a slider", "type a number (or Ctrl+click)"});
  lines.push_back({"Right click", "context menu"});
  add_looking(keymap, lines);
  return lines;
}

std::string looking_words(const workspace::Keymap& keymap) {
  if (keymap.left_orbits()) return "left or middle drag orbits,  right drag pans,  wheel zooms";
  if (keymap.alt_moves_camera()) return "Alt and left drag orbits,  Alt and middle pans,  wheel zooms";
  return "middle or right drag orbits,  Shift pans,  wheel zooms";
}

std::string empty_space_words(const workspace::Keymap& keymap) {
  if (!keymap.left_orbits()) return "on empty space selects;  " + looking_words(keymap);
  return "on empty space orbits;  right drag pans,  wheel zooms,  Shift selects with a box";
}

void status_bar(const Context& ui) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const Window window("Status",
                      {.at = {0, display.y - status_height},
                       .pivot = {0, 0},
                       .size = {display.x, status_height},
                       .rounding = 0,
                       .padding = {12, 5}},
                      fixed_flags | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus);
  const std::string numbers = numbers_text(ui.workspace);
  ImGui::PushFont(ui.fonts.numbers);
  const float numbers_start = display.x - 36 - ImGui::CalcTextSize(numbers.c_str()).x;
  ImGui::PopFont();
  text_right(ui, display.x - 12, numbers, ui.colors.faint);
  text_in(ui.colors.faint, fitting(mouse_text(ui.workspace), numbers_start - ImGui::GetCursorPosX()));
  const float y = display.y - status_height;
  ImGui::GetWindowDrawList()->AddLine({0, y}, {display.x, y}, ui.colors.line);
}

}  // namespace viete::ui
