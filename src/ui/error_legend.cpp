#include <cmath>
#include <string>

#include "ui/format.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr float width = 264, height = 98, inset = 12, thickness = 10;

float place(const scene::ErrorMapStats& map, double log10) {
  return static_cast<float>((log10 - map.low) / (map.high - map.low));
}

void colors(const Context& ui, ImDrawList& draw, ImVec2 at) {
  const std::size_t n = ui.error_colors.size();
  const float step = (width - 2 * inset) / static_cast<float>(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const ImU32 a = ui.error_colors[i], b = ui.error_colors[i + 1];
    const float x = at.x + static_cast<float>(i) * step;
    draw.AddRectFilledMultiColor({x, at.y}, {x + step, at.y + thickness}, a, b, b, a);
  }
}

void ticks(const Context& ui, ImDrawList& draw, ImVec2 at) {
  ImGui::PushFont(ui.fonts.numbers);
  const auto& map = ui.workspace.error_map;
  const int low = static_cast<int>(map.low), high = static_cast<int>(map.high);
  for (int tick = low + 1; tick < high; tick += (high - low + 4) / 5) {
    const float x = at.x + place(map, tick) * (width - 2 * inset);
    draw.AddLine({x, at.y + thickness}, {x, at.y + thickness + 4}, ui.colors.faint);
    const std::string text = "1e" + std::to_string(tick);
    const float half = 0.5f * ImGui::CalcTextSize(text.c_str()).x;
    draw.AddText({x - half, at.y + thickness + 5}, ui.colors.text, text.c_str());
  }
  ImGui::PopFont();
}

}  // namespace

// At the bottom right of the view: what the colours on the mesh say. What is said in the middle goes above
// it.
float error_legend(const Context& ui, float bottom) {
  const auto& w = ui.workspace;
  if (!scene::shows_error_map(w) || ui.error_colors.size() < 2) return bottom;
  const auto& v = w.viewport;
  const ImVec2 low{v.origin.x + v.size.x - width - 16, v.origin.y + v.size.y - height - 16};
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddRectFilled(low, {low.x + width, low.y + height}, faded(ui.colors.card, 0.92f), 8);
  const std::string title = "Error of exp by " + method_label(w.error_map.method);
  const std::string worst = w.error_map.vertices > 0 ? "worst " + error(w.error_map.worst) : "measuring";
  ImGui::PushFont(ui.fonts.text);
  draw.AddText({low.x + inset, low.y + 8}, ui.colors.text, title.c_str());
  draw.AddText({low.x + inset, low.y + 27}, ui.colors.faint, worst.c_str());
  ImGui::PopFont();
  const ImVec2 bar{low.x + inset, low.y + 54};
  colors(ui, draw, bar);
  ticks(ui, draw, bar);
  return low.y + 36;
}

}  // namespace viete::ui
