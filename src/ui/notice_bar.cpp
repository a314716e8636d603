#include <algorithm>
#include <ctime>
#include <initializer_list>
#include <string_view>

#include "scene/commands.h"
#include "scene/recovery.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

std::string edits_of(const scene::Leftover& leftover) {
  return "edits of " + leftover.name + ", " + scene::when(leftover.time, std::time(nullptr));
}

constexpr float apart_gap = 18;

// What loses something stands apart: behind a line, at the far end.
void apart() {
  ImGui::SameLine(0, apart_gap);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddLine({at.x, at.y + 2}, {at.x, at.y + ImGui::GetFrameHeight() - 2},
                                      ImGui::GetColorU32(ImGuiCol_Separator));
  ImGui::Dummy({1, 0});
  ImGui::SameLine(0, apart_gap);
}

float buttons_width(std::initializer_list<std::string_view> commands, float gaps) {
  const ImGuiStyle& style = ImGui::GetStyle();
  float width = gaps;
  for (const auto name : commands) {
    const std::string_view label = scene::find_command(name)->label.brief;
    width += ImGui::CalcTextSize(label.data(), label.data() + label.size()).x + 2 * style.FramePadding.x;
  }
  return width;
}

float inner_room(const Context& ui) {
  return notice_room(ui) - 2 * ImGui::GetStyle().WindowPadding.x;
}

// Beside the one before, or below where the view is too narrow.
void next_button(const Context& ui, std::string_view command, float gap = -1) {
  const float right = ImGui::GetWindowPos().x + ImGui::GetStyle().WindowPadding.x + inner_room(ui);
  const float spacing = gap < 0 ? ImGui::GetStyle().ItemSpacing.x : 2 * gap;
  if (ImGui::GetItemRectMax().x + buttons_width({command}, spacing) <= right)
    gap < 0 ? ImGui::SameLine() : apart();
  command_button(ui, command);
}

// With the buttons beside it, or below where the view is too narrow.
void notice_words(const Context& ui, const std::string& text, const std::string& tip, float buttons) {
  constexpr float gap = 16;
  const float room = inner_room(ui);
  ImGui::AlignTextToFramePadding();
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + room);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  hint(tip);
  if (ImGui::CalcTextSize(text.c_str()).x + gap + buttons <= room) ImGui::SameLine(0, gap);
}

void leftover_line(const Context& ui) {
  const auto& leftovers = ui.workspace.leftovers;
  const std::size_t others = leftovers.size() - 1;
  const std::string more = others > 0 ? "  (and " + std::to_string(others) + " more)" : "";
  notice_words(
      ui, "Kept: unsaved " + edits_of(leftovers.front()) + more,
      leftovers.front().file.string(),
      buttons_width({"restore_leftover", "put_off_leftover", "discard_leftover"}, 2 * apart_gap + 16));
  command_button(ui, "restore_leftover");
  next_button(ui, "put_off_leftover");
  if (leftovers.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Button, 0);
  next_button(ui, "discard_leftover", apart_gap);
  ImGui::PopStyleColor();
}

void discarded_line(const Context& ui) {
  notice_words(ui, "Discarded the " + edits_of(ui.workspace.discarded.back().leftover),
               "They are gone for good when the program ends.",
               buttons_width({"undo_discard", "hide_discarded"}, 8));
  command_button(ui, "undo_discard");
  next_button(ui, "hide_discarded");
}

// As the last thing that is seen.
void farewell(const Context& ui) {
  const auto& v = ui.workspace.viewport;
  ImGui::SetNextWindowPos({v.origin.x + 0.5f * v.size.x, v.origin.y + 0.5f * v.size.y}, ImGuiCond_Always,
                          {0.5f, 0.5f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {24, 16});
  ImGui::Begin("Farewell", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::TextUnformatted("Unsaved edits are kept; the next start offers to bring them back.");
  record(ui, "farewell");
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace

float notice_room(const Context& ui) {
  constexpr float tools = 64, least = 180;  // tools at the left; as much at the right, so that it is centred
  return std::max(least, ui.workspace.viewport.size.x - 2 * tools);
}

// Lines at the top of the view that wait and stop nothing.
void notice_bar(const Context& ui) {
  const auto& w = ui.workspace;
  if (w.farewell) return farewell(ui);
  const bool discarded = w.tell_discarded && !w.discarded.empty();
  if ((w.leftovers.empty() && !discarded) || !w.attended || w.interaction.drag || w.interaction.box) return;
  const auto& v = w.viewport;
  ImGui::SetNextWindowPos({v.origin.x + 0.5f * v.size.x, v.origin.y + 12}, ImGuiCond_Always, {0.5f, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8);
  ImGui::Begin("Notice", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoNav);
  if (!w.leftovers.empty()) leftover_line(ui);
  if (discarded) discarded_line(ui);
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace viete::ui
