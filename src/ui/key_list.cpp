// Every command with its keys: found by a few letters, given another key by a click and the key.
#include <algorithm>
#include <string>
#include <vector>

#include "scene/workspace/menus.h"
#include "ui/imgui_bridge.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr float list_width = 620, keys_width = 150, back_width = 64;

// Without the changes of one's own.
scene::Keymap plain_preset(const scene::Keymap& keymap) {
  scene::Keymap plain;
  plain.set_preset(keymap.preset());
  return plain;
}

// Says why a key of the preset is not there: own changes gave it to another command.
std::string lost_key(const scene::Keymap& keymap, const scene::Keymap& plain, const scene::Command& command) {
  const scene::Shortcut preset = plain.of(command).first;
  const auto losers = keymap.losers(command.name, preset);
  if (losers.empty() || keymap.of(command).first == preset) return "";
  return "\n" + scene::text(preset) + " is of \"" + std::string(losers.front()->label) + "\" now";
}

void key_of_command(const Context& ui, const scene::Keymap& plain, const scene::Command& command) {
  scene::Workspace& w = ui.workspace;
  const std::string name(command.name), keys = scene::text(w.remembered.keymap.of(command));
  const bool waits = w.interaction.setting_key == name;
  if (waits) ImGui::PushStyleColor(ImGuiCol_Text, ui.colors.accent);
  const std::string label = (waits ? "Press a key" : keys.empty() ? "-" : keys) + "##" + name;
  if (ImGui::Button(label.c_str(), {keys_width, 0})) w.interaction.setting_key = waits ? "" : name;
  record(ui, "key/" + name);
  if (waits) ImGui::PopStyleColor();
  if (waits || !ImGui::IsItemHovered()) return;
  hint("Click, and press the new key; Delete takes it away, Esc leaves it." +
       lost_key(w.remembered.keymap, plain, command));
}

void give_back(const Context& ui, const scene::Keymap& plain, const scene::Command& command) {
  scene::Keymap& keymap = ui.workspace.remembered.keymap;
  if (!keymap.changes().contains(command.name)) return;
  ImGui::SameLine();
  const std::string preset = scene::text(plain.of(command));
  if (ImGui::Button(("Reset##" + std::string(command.name)).c_str(), {back_width, 0}))
    keymap.take_back(command.name);
  record(ui, "key/" + std::string(command.name) + "/reset");
  hint("As the keys of the preset have it: " + (preset.empty() ? "none" : preset));
}

void key_row(const Context& ui, const scene::Keymap& plain, const scene::Command& command) {
  const float right = ImGui::GetContentRegionMax().x;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(std::string(command.label).c_str());
  hint(std::string(command.hint));
  ImGui::SameLine(right - keys_width - back_width - ImGui::GetStyle().ItemSpacing.x);
  key_of_command(ui, plain, command);
  give_back(ui, plain, command);
}

void key_heading(const Context& ui, std::string_view title) {
  ImGui::Spacing();
  ImGui::PushFont(ui.fonts.strong);
  ImGui::TextUnformatted(std::string(title).c_str());
  ImGui::PopFont();
}

// What answers something that comes and goes, by a button alone.
bool is_mere_answer(const Context& ui, const scene::Command& command) {
  return command.passing && scene::text(ui.workspace.remembered.keymap.of(command)).empty();
}

// Under the headings of the menus, or what fits what was typed, best first.
void key_rows(const Context& ui) {
  const std::string& typed = ui.workspace.key_list.typed;
  const scene::Keymap plain = plain_preset(ui.workspace.remembered.keymap);
  if (typed.empty()) {
    for (const scene::Menu& menu : scene::menus()) {
      key_heading(ui, menu.title);
      for (const scene::Command* command : menu.items) {
        if (!is_mere_answer(ui, *command)) key_row(ui, plain, *command);
      }
    }
    return;
  }
  const auto found = scene::find_commands(ui.workspace, typed);
  for (const scene::Command* command : found) key_row(ui, plain, *command);
  if (found.empty()) note(ui, "No command has that in its name.");
}

// All changes at once; while the list is open they can be brought back.
void all_back(const Context& ui) {
  scene::KeyList& list = ui.workspace.key_list;
  scene::Keymap& keymap = ui.workspace.remembered.keymap;
  if (!keymap.changes().empty()) list.taken_back.reset();
  const bool brings = list.taken_back.has_value();
  ImGui::BeginDisabled(!brings && keymap.changes().empty());
  if (ImGui::Button(brings ? "Bring changes back" : "Reset all")) {
    if (brings) {
      keymap.put(*std::exchange(list.taken_back, std::nullopt));
    } else {
      list.taken_back = keymap.changes();
      keymap.take_all_back();
    }
  }
  record(ui, "reset_keys", brings || !keymap.changes().empty());
  ImGui::EndDisabled();
  hint(brings ? "The changes that were just taken back." : "All keys as the preset has them.");
}

void close_keys(scene::Workspace& w) {
  w.key_list = {};
  w.interaction.setting_key.clear();
}

}  // namespace

void key_list(const Context& ui) {
  scene::Workspace& w = ui.workspace;
  if (!w.key_list.open) return;
  const scene::Viewport& v = w.viewport;
  bool open = true;
  const Window window("All keys",
                      {.at = {0.5f * v.window.x, v.origin.y + 0.5f * v.size.y},
                       .size = {std::min(list_width, v.window.x - 32), std::min(620.0f, v.size.y - 110)}},
                      dialog_flags, &open);
  command_choice(ui, {"keys_viete", "keys_blender", "keys_maya", "keys_viewer"},
                 static_cast<std::size_t>(w.remembered.keymap.preset()));
  search_field(ui, "keys_text", w.key_list.typed, w.key_list.appearing);
  ImGui::BeginChild("rows", {0, -(ImGui::GetFrameHeight() + 8)});
  key_rows(ui);
  ImGui::EndChild();
  all_back(ui);
  ImGui::SameLine();
  if (ImGui::Button("Close")) open = false;
  record(ui, "close_keys");
  const bool waits = !w.interaction.setting_key.empty();
  // The Esc that leaves a key as it is closes nothing.
  if (key_pressed(scene::Key::escape) && !waits && !w.key_list.waiting) open = false;
  w.key_list.waiting = waits;
  if (!open) close_keys(w);
}

float key_question(const Context& ui, float bottom) {
  scene::Workspace& w = ui.workspace;
  if (!w.view.hints) w.ask_keys = false;  // the hand is at work already
  if (!w.ask_keys || !w.view.panels || w.view.help || w.loading.running || w.browser.open || w.question ||
      offers_next_step(w))
    return bottom;
  const Window window(
      "Which keys", {.at = middle_at(ui, bottom - 56), .pivot = {0.5f, 1}, .padding = {16, 12}}, card_flags);
  ImGui::TextUnformatted("Whose keys do your hands know?");
  const auto presets = scene::choices(scene::KeyPreset{});
  for (std::size_t i = 0; i < presets.size(); ++i) {
    if (i > 0) ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    if (ImGui::Button(presets[i].label.data(), {72, 0})) {
      w.remembered.keymap.set_preset(static_cast<scene::KeyPreset>(i));
      w.ask_keys = false;
    }
    record(ui, "ask_keys/" + std::string(presets[i].word));
    hint(std::string(presets[i].hint) + " Help, Change keys has them all, at any time.");
  }
  ImGui::SameLine();
  if (ImGui::Button("x")) w.ask_keys = false;
  record(ui, "ask_keys/close");
  hint("Those of Viete.");
  return ImGui::GetWindowPos().y + 28;
}

}  // namespace viete::ui
