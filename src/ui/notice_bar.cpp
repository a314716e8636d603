#include <algorithm>
#include <ctime>
#include <initializer_list>
#include <string_view>

#include "scene/files/recovery.h"
#include "scene/workspace/command.h"
#include "scene/workspace/file_commands.h"
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
    const std::string_view label = scene::find_command(name)->brief;
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

// The last folders of it, as many as there is room for.
std::string shortened_folder(std::string folder, float width) {
  const std::string cut = "...";
  for (std::size_t slash = 0; ImGui::CalcTextSize(folder.c_str()).x > width;) {
    slash = folder.find('/', folder.starts_with(cut) ? cut.size() + 1 : 1);
    if (slash == std::string::npos) break;
    folder = cut + folder.substr(slash);
  }
  return shortened(folder, width);
}

// At both ends of a line.
void two_texts(ImVec2 at, float width, const std::string& left, const std::string& right, ImU32 color) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddText(at, color, left.c_str());
  draw.AddText({at.x + width - ImGui::CalcTextSize(right.c_str()).x, at.y}, color, right.c_str());
}

// What it is of and when; below, where that lies and how the edits began.
void leftover_texts(const Context& ui, const scene::Leftover& leftover, ImVec2 at, float width) {
  constexpr float gap = 16;
  const auto room_beside = [&](const std::string& text) {
    return width - ImGui::CalcTextSize(text.c_str()).x - gap;
  };
  const std::string when = scene::when(leftover.time, std::time(nullptr));
  two_texts(at, width, shortened(leftover.name, room_beside(when)), when, ui.colors.text);
  const std::string began = leftover.first_edit.empty() ? "" : "began with: " + leftover.first_edit;
  const std::string edit = shortened(began, 0.6f * width);
  at.y += ImGui::GetTextLineHeight();
  two_texts(at, width, shortened_folder(leftover.folder.string(), room_beside(edit)), edit, ui.colors.faint);
}

// One of several can be chosen.
void leftover_row(const Context& ui, std::size_t i, float width) {
  auto& w = ui.workspace;
  const scene::Leftover& leftover = w.leftovers[i];
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size(width, 2 * ImGui::GetTextLineHeight());
  const bool chosen = w.leftovers.size() > 1 && &scene::offered_leftover(w) == &leftover;
  const std::string name = "leftover/" + std::to_string(i);
  if (w.leftovers.size() == 1) {
    ImGui::Dummy(size);
  } else if (ImGui::Selectable(("##" + name).c_str(), chosen, 0, size)) {
    w.chosen_leftover = leftover.file;
  }
  leftover_texts(ui, leftover, at, width);
  record(ui, name);
  hint("Edits of " + (leftover.folder / leftover.name).string() + "\nkept in " + leftover.file.string());
}

// Few at once: the others are reached by the wheel.
void leftover_rows(const Context& ui) {
  constexpr float widest = 460, most = 3.5f;
  const std::size_t count = ui.workspace.leftovers.size();
  const float width = std::min(widest, inner_room(ui));
  const float row = 2 * ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y;
  ImGui::PushStyleColor(ImGuiCol_Header, ui.colors.card_active);
  ImGui::BeginChild("Leftovers", {width, row * std::min(most, static_cast<float>(count))});
  const float inner = ImGui::GetContentRegionAvail().x;
  for (std::size_t i = 0; i < count; ++i) leftover_row(ui, i, inner);
  ImGui::EndChild();
  ImGui::PopStyleColor();
}

void leftover_offer(const Context& ui) {
  const std::size_t count = ui.workspace.leftovers.size();
  ImGui::TextUnformatted(count == 1 ? "Unsaved edits were kept:" : "Unsaved edits were kept; choose one:");
  leftover_rows(ui);
  command_button(ui, "restore_leftover");
  next_button(ui, "put_off_leftover");
  if (ui.workspace.leftovers.empty()) return;
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
  const Window window("Farewell", {.at = middle_of_view(ui), .padding = {24, 16}}, sized_flags);
  ImGui::TextUnformatted("Unsaved edits are kept; the next start offers to bring them back.");
  record(ui, "farewell");
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
  const Window window("Notice", {.at = middle_at(ui, w.viewport.origin.y + 12), .pivot = {0.5f, 0}},
                      card_flags);
  if (!w.leftovers.empty()) leftover_offer(ui);
  if (discarded) discarded_line(ui);
}

}  // namespace viete::ui
