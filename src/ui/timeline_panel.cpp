// The timeline below the view: playback, keys and their easing.
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "document/time_edit.h"
#include "ui/choice_list.h"
#include "ui/imgui_bridge.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/command_conditions.h"
#include "workspace/playing.h"
#include "workspace/time_gestures.h"
#include "workspace/time_view.h"

namespace viete::ui {

namespace {

constexpr float bar_height = 24, more_width = 28, icon = 5;

void arrow(const Pen& pen, float x, float length) {
  pen.draw.AddTriangleFilled(pen.at(x + length, 0), pen.at(x - 0.4f * length, -0.9f),
                             pen.at(x - 0.4f * length, 0.9f), pen.color);
}
void bar(const Pen& pen, float x) {
  pen.draw.AddRectFilled(pen.at(x - 0.18f, -0.9f), pen.at(x + 0.18f, 0.9f), pen.color);
}
void diamond(const Pen& pen, float x) {
  pen.draw.AddQuadFilled(pen.at(x, -0.7f), pen.at(x + 0.6f, 0), pen.at(x, 0.7f), pen.at(x - 0.6f, 0),
                         pen.color);
}

void first_icon(const Pen& pen, bool) {
  bar(pen, -0.9f);
  arrow(pen, 0.1f, -0.8f);
}
void previous_key_icon(const Pen& pen, bool) {
  diamond(pen, 0.8f);
  arrow(pen, -0.4f, -0.8f);
}
void play_icon(const Pen& pen, bool playing) {
  if (!playing) return arrow(pen, -0.15f, 1.1f);
  bar(pen, -0.45f);
  bar(pen, 0.45f);
}
void next_key_icon(const Pen& pen, bool) {
  diamond(pen, -0.8f);
  arrow(pen, 0.4f, 0.8f);
}
void last_icon(const Pen& pen, bool) {
  bar(pen, 0.9f);
  arrow(pen, -0.1f, 0.8f);
}
void key_icon(const Pen& pen, bool) {
  diamond(pen, 0);
}
void camera_icon(const Pen& pen, bool) {
  pen.draw.AddRect(pen.at(-1, -0.6f), pen.at(0.4f, 0.6f), pen.color, 1, 0, 1.25f);
  pen.draw.AddTriangleFilled(pen.at(0.4f, 0), pen.at(1, -0.5f), pen.at(1, 0.5f), pen.color);
}
void auto_icon(const Pen& pen, bool on) {
  if (on) return pen.draw.AddCircleFilled(pen.middle, 0.8f * icon, pen.color);
  pen.draw.AddCircle(pen.middle, 0.8f * icon, pen.color, 0, 1.25f);
}
void export_icon(const Pen& pen, bool) {
  pen.draw.AddLine(pen.at(0, 0.4f), pen.at(0, -0.7f), pen.color, 1.25f);
  pen.draw.AddTriangleFilled(pen.at(0, -1.1f), pen.at(-0.5f, -0.4f), pen.at(0.5f, -0.4f), pen.color);
  const ImVec2 tray[] = {pen.at(-0.9f, 0.2f), pen.at(-0.9f, 0.9f), pen.at(0.9f, 0.9f), pen.at(0.9f, 0.2f)};
  pen.draw.AddPolyline(tray, 4, pen.color, 0, 1.25f);
}

void icon_button(const Context& ui, const char* name, void (*draw)(const Pen&, bool)) {
  const workspace::Command& command = *workspace::find_command(name);
  const bool enabled = command.enabled(ui.workspace), on = command.on(ui.workspace);
  if (on) ImGui::PushStyleColor(ImGuiCol_Button, ui.colors.card_active);
  if (button(ui, (std::string("##") + name).c_str(), std::string("time/") + name,
             std::string(command.label) + ".  " + hint_of(ui, command), {28, bar_height}, enabled))
    command.run(ui.workspace);
  if (on) ImGui::PopStyleColor();
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const ImU32 color = faded(on ? ui.colors.accent : ui.colors.text, enabled ? 1 : 0.35f);
  draw({*ImGui::GetWindowDrawList(), {0.5f * (low.x + high.x), 0.5f * (low.y + high.y)}, color, icon}, on);
}

std::optional<int> frame_field(const Context& ui, const char* label, const char* name, double value,
                               float width, const char* what) {
  if (*label) {
    ImGui::AlignTextToFramePadding();
    text_in(ui.colors.faint, label);
    ImGui::SameLine(0, 4);
  }
  const auto typed = number_field(ui, name, value, width, what);
  if (!typed || !std::isfinite(*typed)) return std::nullopt;
  constexpr double largest = document::Timeline::largest_frame;
  return static_cast<int>(std::lround(std::clamp(*typed, -largest, largest)));
}

void frame_shown(const Context& ui) {
  workspace::Workspace& w = ui.workspace;
  const double shown = std::round(w.document.frame() * 10) / 10;
  if (const auto frame = frame_field(ui, "Frame", "time/frame", shown, 64, "Current frame.")) {
    workspace::stop_playing(w);
    workspace::go_to_frame(w, *frame);
  }
}

// A part of a row. A part that does not fit moves to the menu at the end of the row.
struct ToolPiece {
  float width, gap;
  std::function<void()> draw;
  std::function<void()> in_menu = draw;
};

ToolPiece button_piece(const Context& ui, const char* name, void (*icon)(const Pen&, bool), float gap = 4) {
  return {28, gap, [&ui, name, icon] { icon_button(ui, name, icon); },
          [&ui, name] { menu_item(ui, *workspace::find_command(name)); }};
}

std::size_t fitting_pieces(std::span<const ToolPiece> pieces, float room) {
  std::size_t count = 0;
  for (float taken = 0; count < pieces.size(); ++count) {
    taken += pieces[count].gap + pieces[count].width;
    if (taken > room) break;
  }
  return count;
}

// A menu of the parts that do not fit.
void more_pieces(const Context& ui, const char* name, std::span<const ToolPiece> others) {
  if (button(ui, (std::string("##") + name).c_str(), name, "More timeline settings.",
             {more_width, bar_height}))
    ImGui::OpenPopup(name);
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  for (const float x : {-5.0f, 0.0f, 5.0f})
    ImGui::GetWindowDrawList()->AddCircleFilled({0.5f * (low.x + high.x) + x, 0.5f * (low.y + high.y)}, 1.6f,
                                                ui.colors.text);
  if (!ImGui::BeginPopup(name)) return;
  if (key_pressed(workspace::Key::escape)) ImGui::CloseCurrentPopup();
  for (const ToolPiece& piece : others) piece.in_menu();
  ImGui::EndPopup();
}

// Adds the parts to the current row, up to x = `right`.
void row_of_pieces(const Context& ui, const char* menu, std::span<const ToolPiece> pieces, float right) {
  const float room = right - ImGui::GetItemRectMax().x;
  std::size_t count = fitting_pieces(pieces, room);
  if (count < pieces.size()) count = fitting_pieces(pieces, room - 4 - more_width);
  for (const ToolPiece& piece : pieces.first(count)) {
    ImGui::SameLine(0, piece.gap);
    piece.draw();
  }
  if (count == pieces.size()) return;
  ImGui::SameLine(0, 4);
  more_pieces(ui, menu, pieces.subspan(count));
}

void transport(const Context& ui, float right) {
  constexpr std::pair<const char*, void (*)(const Pen&, bool)> first[] = {{"first_frame", first_icon},
                                                                          {"previous_key", previous_key_icon},
                                                                          {"play", play_icon},
                                                                          {"next_key", next_key_icon}};
  for (const auto& [name, icon] : first) {
    icon_button(ui, name, icon);
    ImGui::SameLine();
  }
  icon_button(ui, "last_frame", last_icon);
  const ToolPiece pieces[] = {{112, 12, [&] { frame_shown(ui); }},
                              button_piece(ui, "set_key", key_icon, 12),
                              button_piece(ui, "set_camera_key", camera_icon),
                              button_piece(ui, "toggle_auto_key", auto_icon),
                              button_piece(ui, "save_animation", export_icon, 12)};
  row_of_pieces(ui, "time/more", pieces, right);
}

void interpolation_choice(const Context& ui) {
  const bool linear = ui.workspace.document.timeline().linear;
  const workspace::Command& command = *workspace::find_command("toggle_linear");
  const char* labels[] = {"Log space", "Linear"};
  constexpr float widths[] = {76, 56};
  const char* hints[] = {
      "Interpolate rotation and stretch between poses: halfway to 180 degrees is 90 degrees.",
      "Interpolate vertex positions linearly between poses. Rotating parts shrink."};
  ImGui::BeginDisabled(!command.enabled(ui.workspace));
  for (int i = 0; i < 2; ++i) {
    if (i > 0) ImGui::SameLine(0, 2);
    const bool on = linear == (i == 1);
    if (on) ImGui::PushStyleColor(ImGuiCol_Button, ui.colors.card_active);
    if (on) ImGui::PushStyleColor(ImGuiCol_Text, ui.colors.accent);
    if (button(ui, labels[i], i == 0 ? "time/log_space" : "time/linear", hints[i], {widths[i], bar_height}) &&
        !on)
      command.run(ui.workspace);
    if (on) ImGui::PopStyleColor(2);
  }
  ImGui::EndDisabled();
}

void rate_field(const Context& ui) {
  document::Document& document = ui.workspace.document;
  document::Playing play = document.timeline();
  const auto rate =
      number_field(ui, "time/rate", play.rate, 40, "Playback rate in frames per second, 1 to 240.");
  ImGui::SameLine(0, 4);
  ImGui::AlignTextToFramePadding();
  text_in(ui.colors.faint, "fps");
  if (!rate || !std::isfinite(*rate)) return;
  play.rate = *rate;
  document::set_play(document, play);
}

void easing_choice(const Context& ui) {
  const workspace::Workspace& w = ui.workspace;
  const workspace::KeyPlaces eased = workspace::eased_keys(w);
  const auto easing =
      eased.empty() ? std::nullopt : document::easing_at(w.document.timeline(), eased.front());
  ImGui::BeginDisabled(!easing);
  choice_list(ui, "time/easing", easing, 132,
              {"time/", "Easing",
               "Interpolation from the selected keys, or from the key before this frame, to the next key."});
  ImGui::EndDisabled();
}

void range(const Context& ui, float right) {
  document::Document& document = ui.workspace.document;
  document::Playing play = document.timeline();
  if (const auto first =
          frame_field(ui, "From", "time/first", play.first, 44, "First frame of the playback range.")) {
    play.first = *first;
    play.last = std::max(play.last, *first + 1);
  }
  ImGui::SameLine(0, 8);
  if (const auto last =
          frame_field(ui, "to", "time/last", play.last, 44, "Last frame of the playback range.")) {
    play.last = *last;
    play.first = std::min(play.first, *last - 1);
  }
  document::set_play(document, play);
  const ToolPiece pieces[] = {{76, 8, [&] { rate_field(ui); }},
                              {92, 8,
                               [&] {
                                 choice_list(ui, "time/repeat", std::optional(document.timeline().repeat), 92,
                                             {.prefix = "time/"});
                               }},
                              {134, 8, [&] { interpolation_choice(ui); }},
                              {132, 8, [&] { easing_choice(ui); }}};
  row_of_pieces(ui, "time/more_of_range", pieces, right);
}

}  // namespace

void timeline_panel(const Context& ui) {
  workspace::Workspace& w = ui.workspace;
  w.view.time.hovered = false;
  if (!w.preferences.layout.timeline) return;
  const document::Viewport& v = w.view.viewport;
  const float edge = v.origin.y + v.size.y;
  const Window window("Timeline",
                      {.at = {v.origin.x, edge},
                       .pivot = {0, 0},
                       .size = {v.size.x, w.preferences.layout.timeline_height()},
                       .rounding = 0,
                       .padding = {10, 8}},
                      fixed_flags | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus |
                          ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {4, 6});
  w.view.time.hovered =
      ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem | ImGuiHoveredFlags_ChildWindows);
  ImGui::GetWindowDrawList()->AddLine({v.origin.x, edge}, {v.origin.x + v.size.x, edge}, ui.colors.line);
  const ImVec2 low = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  ImGui::BeginDisabled(!w.document.model().surface);
  transport(ui, low.x + room.x);
  const ImVec2 top = ImGui::GetCursorScreenPos();
  const float bottom = low.y + room.y - bar_height - 6;
  timeline_track(ui, top, {low.x + room.x, bottom});
  ImGui::SetCursorScreenPos({low.x, bottom + 6});
  range(ui, low.x + room.x);
  ImGui::EndDisabled();
  ImGui::PopStyleVar();
}

}  // namespace viete::ui
