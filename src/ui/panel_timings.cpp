#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "ui/format.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr std::size_t part_count = scene::link_count + 4;
using Parts = std::array<double, part_count>;

Parts parts_of(const scene::FrameTimes& frame) {
  Parts parts{};
  std::copy(frame.links.ms.begin(), frame.links.ms.end(), parts.begin());
  parts[scene::link_count] = frame.upload;
  parts[scene::link_count + 1] = frame.draw;
  parts[scene::link_count + 2] = frame.panels;
  parts[scene::link_count + 3] = std::max(0.0, frame.other());
  return parts;
}

std::string part_name(std::size_t part) {
  static constexpr const char* others[] = {"upload", "draw", "panels", "other"};
  if (part >= scene::link_count) return others[part - scene::link_count];
  return std::string(name(static_cast<scene::Link>(part)));
}

void bar(const Parts& parts, double total) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = 14;
  float x = at.x;
  for (std::size_t i = 0; i < part_count; ++i) {
    const float w = static_cast<float>(parts[i] / std::max(total, 1e-9)) * width;
    ImGui::GetWindowDrawList()->AddRectFilled({x, at.y}, {x + w, at.y + height}, part_color(i));
    x += w;
  }
  ImGui::Dummy({width, height});
}

void legend_entry(const Context& ui, std::size_t part, double ms, ImVec2 at, float width) {
  const float line = ImGui::GetTextLineHeight(), middle = at.y + 0.5f * line;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled({at.x, middle - 4}, {at.x + 8, middle + 4}, part_color(part), 2);
  draw.AddText({at.x + 16, at.y}, ui.colors.faint, part_name(part).c_str());
  text_right(ui, at.x + width, milliseconds(ms), ui.colors.text);
}

// Two columns, read downwards; links that this frame does not have are left out.
void legend(const Context& ui, const Parts& parts) {
  std::array<std::size_t, part_count> shown{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < part_count; ++i) {
    if (i >= scene::link_count || parts[i] > 0) shown[count++] = i;
  }
  const std::size_t rows = (count + 1) / 2;
  constexpr float gap = 16;
  const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
  for (std::size_t row = 0; row < rows; ++row) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    legend_entry(ui, shown[row], parts[shown[row]], at, width);
    const std::size_t right = row + rows;
    if (right < count) legend_entry(ui, shown[right], parts[shown[right]], {at.x + width + gap, at.y}, width);
    ImGui::Dummy({0, ImGui::GetTextLineHeight()});
  }
}

// One column of pixels per frame, stacked like the bar, newest at the right.
void history(const Context& ui) {
  const auto& frames = ui.workspace.stats.history();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = 56;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(at, {at.x + width, at.y + height}, ui.colors.card, 4);
  double top = 1;
  for (const auto& frame : frames) top = std::max(top, frame.frame);
  constexpr float step = 2;
  float x = at.x + width -
            step * static_cast<float>(std::min<std::size_t>(frames.size(), std::size_t(width / step)));
  for (std::size_t f = frames.size() - std::size_t((at.x + width - x) / step); f < frames.size();
       ++f, x += step) {
    float y = at.y + height;
    const Parts parts = parts_of(frames[f]);
    for (std::size_t i = 0; i < part_count; ++i) {
      const float h = static_cast<float>(parts[i] / top) * (height - 4);
      draw.AddRectFilled({x, y - h}, {x + step, y}, part_color(i));
      y -= h;
    }
  }
  ImGui::Dummy({width, height});
  hint("The last " + count(frames.size()) + " frames that deformed; full height is " + milliseconds(top) +
       ".");
}

}  // namespace

void panel_timings(const Context& ui) {
  if (!section(ui, "Timings")) return;
  const auto median = ui.workspace.stats.median();
  if (!median) {
    note(ui, ui.workspace.document.is_movable()
                 ? "Drag a vertex of the cage, or a probe, to see what each link of the frame costs."
                 : "What each link of the frame costs is shown once a cage or a probe moves the model.");
    return;
  }
  const Parts parts = parts_of(*median);
  double total = 0;
  for (const double ms : parts) total += ms;
  value_row(ui, "Frame", milliseconds(median->frame));
  bar(parts, total);
  legend(ui, parts);
  if (const double error = ui.workspace.fused_error; error > 0) {
    char text[32];
    std::snprintf(text, sizeof text, "%.0e of the size", error);
    value_row(ui, "Error, measured", text);
  }
  history(ui);
}

}  // namespace viete::ui
