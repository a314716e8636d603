// The deformation of a frame with each method, stage by stage, and the rest of the frame.
#include <algorithm>
#include <array>

#include "scene/document/edit.h"
#include "ui/format.h"
#include "ui/panels.h"
#include "ui/stages.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

using scene::compared_methods;
using scene::Link;
using Stage = std::optional<Link>;

constexpr std::size_t all_methods = compared_methods.size();

bool is_under_cursor(ImVec2 low, ImVec2 high) {
  return ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, high);
}

// One segment per stage, as long as its share of the slowest method's time.
Stage segments(const Context& ui, const scene::LinkTimes& times, double longest, ImVec2 at, float width) {
  constexpr float height = 14;
  Stage under_cursor;
  float x = at.x;
  for (std::size_t i = 0; i < scene::link_count; ++i) {
    const float w = static_cast<float>(times.ms[i] / longest) * width;
    const ImVec2 low{x, at.y + 2}, high{x + w, at.y + 2 + height};
    ImGui::GetWindowDrawList()->AddRectFilled(low, high, lit_stage_color(ui, static_cast<Link>(i)));
    if (w > 0 && is_under_cursor(low, high)) under_cursor = static_cast<Link>(i);
    x += w;
  }
  return under_cursor;
}

Stage bar(const Context& ui, std::size_t index, double longest) {
  constexpr float label_width = 88, value_width = 68;
  const scene::MethodTimes& all = ui.workspace.method_times;
  const scene::LinkTimes& times = all.links[index];
  const bool runs = compared_methods[index] == ui.workspace.document.method;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, room = width - label_width - value_width;
  text_in(runs ? ui.colors.accent : ui.colors.faint, method_label(compared_methods[index]));
  record(ui, "timings/" + method_label(compared_methods[index]));
  if (times.total() > 0) {
    text_right(ui, at.x + width, milliseconds(times.total()), ui.colors.text, at.y);
    return segments(ui, times, longest, {at.x + label_width, at.y}, room);
  }
  if (all.measured)
    ImGui::GetWindowDrawList()->AddText({at.x + label_width, at.y}, ui.colors.faint,
                                        "large weights: choose it to measure");
  return std::nullopt;
}

bool is_measured(const scene::MethodTimes& all, Link stage) {
  return std::ranges::any_of(all.links, [&](const auto& times) { return times[stage] > 0; });
}

// The stages of all bars, four to a line.
Stage legend(const Context& ui) {
  constexpr std::size_t columns = 4, rows = 2;
  const scene::Workspace& w = ui.workspace;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x / columns, line = ImGui::GetTextLineHeight() + 2;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  Stage under_cursor;
  std::size_t count = 0;
  for (std::size_t i = 0; i < scene::link_count; ++i) {
    const Link stage = static_cast<Link>(i);
    if (!is_measured(w.method_times, stage)) continue;
    const ImVec2 low{at.x + static_cast<float>(count % columns) * width,
                     at.y + static_cast<float>(count / columns) * line};
    const float middle = low.y + 0.5f * line;
    draw.AddRectFilled({low.x, middle - 4}, {low.x + 8, middle + 4}, lit_stage_color(ui, stage), 2);
    const bool lit = w.interaction.stage == stage;
    draw.AddText({low.x + 13, low.y}, lit ? ui.colors.text : ui.colors.faint,
                 std::string(name(stage)).c_str());
    if (is_under_cursor(low, {low.x + width, low.y + line})) under_cursor = stage;
    ++count;
  }
  const std::size_t lines = std::max(rows, (count + columns - 1) / columns);
  ImGui::Dummy({1, static_cast<float>(lines) * line});
  return under_cursor;
}

void tell_stage(const Context& ui, Link stage) {
  std::string text = std::string(name(stage)) + ": " + stage_hint(stage);
  for (std::size_t i = 0; i < all_methods; ++i) {
    const double ms = ui.workspace.method_times.links[i][stage];
    if (ms > 0) text += "\n" + method_label(compared_methods[i]) + ": " + milliseconds(ms);
  }
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(wrapped(text, 268).c_str());
  ImGui::EndTooltip();
}

// The rest of a frame and its total: headings above their numbers.
void rest_of_frame(const Context& ui) {
  struct Column {
    const char* heading;
    float right;  // as a part of the width
    std::string value{};
  };
  std::array<Column, 5> columns{
      {{"upload", 0.17f}, {"panels", 0.36f}, {"draw", 0.53f}, {"total", 0.75f}, {"frames/s", 1}}};
  if (const auto& frame = ui.workspace.stats.median()) {
    columns[0].value = base::few_digits(frame->upload);
    columns[1].value = base::few_digits(frame->panels);
    columns[2].value = base::few_digits(frame->draw);
    columns[3].value = milliseconds(frame->frame);
    columns[4].value = base::few_digits(1000 / std::max(frame->frame, 1e-3));
  }
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, line = ImGui::GetTextLineHeight();
  for (const Column& column : columns) {
    const float right = at.x + column.right * width;
    ImGui::GetWindowDrawList()->AddText({right - ImGui::CalcTextSize(column.heading).x, at.y},
                                        ui.colors.faint, column.heading);
    text_right(ui, right, column.value, ui.colors.text, at.y + line);
  }
  ImGui::Dummy({width, 2 * line});
  hint(
      "The rest of a frame in milliseconds, medians of the last half second. The total has the deformation "
      "too. "
      "On a software renderer, drawing uses the processor.");
}

// The error of the exponential, and of the positions that are drawn.
void errors(const Context& ui) {
  const scene::Workspace& w = ui.workspace;
  const scene::MethodSample* sample = running_sample(w);
  const bool fits = ImGui::GetContentRegionAvail().x >
                    ImGui::CalcTextSize("exp 4e-16 \u00b7 frame 4e-6, single precision").x;
  std::string text = sample ? "exp " + rough_error(sample->worst_error) : "", frame;
  if (w.fused_error > 0)
    frame = "frame " + rough_error(w.fused_error) + (fits ? ", single precision" : ", single");
  else if (scene::shows_links(w))
    frame = "frame in double precision";
  text += (text.empty() || frame.empty() ? "" : " \u00b7 ") + frame;
  if (text.empty()) text = " ";
  text_in(ui.colors.faint, text);
  record(ui, "errors");
  hint(
      "exp: largest relative error of the exponentials. frame: largest distance of the drawn vertices from "
      "the "
      "same frame in double precision, in diagonals of the cage.");
}

}  // namespace

void panel_timings(const Context& ui) {
  scene::Workspace& w = ui.workspace;
  heading(ui, "Timings of the deformation");
  double longest = 1e-9;
  for (const auto& times : w.method_times.links) longest = std::max(longest, times.total());
  Stage stage;
  for (std::size_t i = 0; i < all_methods; ++i)
    if (const Stage hit = bar(ui, i, longest)) stage = hit;
  if (const Stage hit = legend(ui)) stage = hit;
  w.interaction.stage = stage;
  if (stage) tell_stage(ui, *stage);
  rest_of_frame(ui);
  ImGui::BeginDisabled(!w.document.scheme.exponential());
  command_toggle(ui, "toggle_same_path", w.view.same_path);
  ImGui::EndDisabled();
  errors(ui);
}

}  // namespace viete::ui
