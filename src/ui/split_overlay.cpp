// A view that is split: lines between its parts, and what each of them shows.
#include <algorithm>
#include <cfloat>
#include <initializer_list>
#include <optional>
#include <string>

#include "ui/format.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr float tools_room = 60, axes_room = 112;  // of what stands at the edges of the view

// Where some view has other lines than the document.
std::string lines_words(const scene::Workspace& w, bool other) {
  const auto has_other = [](const scene::SideView& side) { return side.other_lines; };
  if (std::ranges::none_of(w.split.sides, has_other)) return "";
  return w.document.timeline.straight != other ? "straight lines" : "log space";
}

std::string joined(std::initializer_list<std::string> words) {
  std::string all;
  for (const std::string& word : words)
    if (!word.empty()) all += (all.empty() ? "" : " \u00b7 ") + word;
  return all;
}

struct Caption {
  std::string title, numbers;
};

std::string way_words(const scene::Scheme& scheme) {
  const auto way = scene::way_of(scheme);
  return way ? std::string(scene::entry(*way).label) : "A way of your own";
}

// "1.9 ms   exp 3e-16   frame 2e-08".
std::string numbers(const scene::FrameStats& stats, std::optional<double> exp_error, double fused_error) {
  const auto times = stats.deforming_median();
  std::string words = times ? milliseconds(times->links.total()) : "";
  if (exp_error) words += "   exp " + error(*exp_error);
  if (fused_error > 0) words += "   frame " + error(fused_error);
  return words;
}

std::string title_of(const scene::Workspace& w, const scene::Scheme& scheme, scene::Method method,
                     bool other_lines) {
  const bool cage = w.document.has_cage();
  return joined({cage ? way_words(scheme) : "", cage && scheme.exponential() ? method_label(method) : "",
                 lines_words(w, other_lines)});
}

Caption shown_in(const scene::Workspace& w, std::size_t view) {
  if (view == 0) {
    const scene::MethodSample* sample = running_sample(w);
    return {title_of(w, w.document.scheme, w.document.method, false),
            numbers(w.stats, sample ? std::optional(sample->worst_error) : std::nullopt, w.fused_error)};
  }
  const scene::SideView& side = w.split.sides[view - 1];
  Caption shown{title_of(w, side.scheme, side.method, side.other_lines),
                numbers(side.stats, side.exp_error, side.fused_error)};
  if (side.binding) shown.numbers = "binding";
  if (!side.problem.empty()) shown.numbers = side.problem;
  return shown;
}

ImVec2 size_of(ImFont* font, const std::string& text, float wide) {
  if (text.empty()) return {0, 0};
  return font->CalcTextSizeA(font->FontSize * ImGui::GetIO().FontGlobalScale, FLT_MAX, wide, text.c_str());
}

// At the upper left of its part, on as many lines as it needs there.
void caption(const Context& ui, std::size_t view, glm::vec2 at, float room) {
  const ImVec2 padding{10, 6};
  const Caption shown = shown_in(ui.workspace, view);
  if (shown.title.empty() && shown.numbers.empty()) return;
  const float most = std::max(room - 16 - 2 * padding.x, 1.0f), scale = ImGui::GetIO().FontGlobalScale;
  ImFont *strong = ui.fonts.strong, *small = ui.fonts.numbers;
  const ImVec2 title = size_of(strong, shown.title, most), below = size_of(small, shown.numbers, most);
  const float gap = title.y > 0 && below.y > 0 ? 3 : 0;
  const ImVec2 low{at.x + 8, at.y + 8}, text{low.x + padding.x, low.y + padding.y};
  const ImVec2 high{text.x + std::min(std::max(title.x, below.x), most) + padding.x,
                    text.y + title.y + gap + below.y + padding.y};
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddRectFilled(low, high, faded(ui.colors.card, 0.85f), 6);
  draw.PushClipRect(low, high, true);  // a word may be wider than the room
  draw.AddText(strong, strong->FontSize * scale, text, ui.colors.text, shown.title.c_str(), nullptr, most);
  draw.AddText(small, small->FontSize * scale, {text.x, text.y + title.y + gap}, ui.colors.faint,
               shown.numbers.c_str(), nullptr, most);
  draw.PopClipRect();
}

void frame(const Context& ui, const scene::Pane& pane) {
  const scene::Viewport& v = ui.workspace.viewport;
  const glm::vec2 low = glm::round(v.origin + pane.at * v.size);
  const glm::vec2 high = glm::round(v.origin + (pane.at + pane.size) * v.size);
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  if (pane.at.x > 0) draw.AddLine({low.x, low.y}, {low.x, high.y}, ui.colors.line, 1.5f);
  if (pane.at.y > 0) draw.AddLine({low.x, low.y}, {high.x, low.y}, ui.colors.line, 1.5f);
}

// Takes hold of the line of a wipe.
void wipe_line(const Context& ui) {
  constexpr float thickness = 10, knob = 9;
  scene::Split& split = ui.workspace.split;
  const scene::Viewport& v = ui.workspace.viewport;
  const float x = v.origin.x + split.line * v.size.x;
  const Window window("Wipe",
                      {.at = {x, v.origin.y},
                       .pivot = {0.5f, 0},
                       .size = {thickness, v.size.y},
                       .rounding = 0,
                       .padding = {0, 0}},
                      fixed_flags | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoFocusOnAppearing |
                          ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::InvisibleButton("line", {thickness, v.size.y});
  record(ui, "wipe_line");
  const bool held = ImGui::IsItemActive(), over = held || ImGui::IsItemHovered();
  if (over) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 color = over ? ui.colors.accent : ui.colors.text;
  const float y = v.origin.y + 0.5f * v.size.y;
  draw.PushClipRectFullScreen();
  draw.AddLine({x, v.origin.y}, {x, v.origin.y + v.size.y}, faded(color, 0.8f), 1.5f);
  draw.AddCircleFilled({x, y}, knob, color);
  draw.PopClipRect();
  if (held)
    split.line = std::clamp((ImGui::GetIO().MousePos.x - v.origin.x) / v.size.x, scene::Split::least_part,
                            1 - scene::Split::least_part);
}

}  // namespace

// Overlays of the hand stand in the view where it works, and those that one camera sees alike have them too.
void repeat_in_views(const Context& ui, const DrawnBefore& before) {
  const scene::Split& split = ui.workspace.split;
  if (!split.on() || split.wipes() || !split.linked) return;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const int vertices = draw.VtxBuffer.Size - before.vertices, indices = draw.IdxBuffer.Size - before.indices;
  if (vertices == 0) return;
  const glm::vec2 from = scene::pane_of(split, split.active).at;
  const scene::Viewport& v = ui.workspace.viewport;
  for (std::size_t view = 0; view < split.count(); ++view) {
    if (view == split.active) continue;
    const scene::Pane pane = scene::pane_of(split, view);
    const glm::vec2 shift = (pane.at - from) * v.size, low = v.origin + pane.at * v.size;
    draw.PushClipRect(vec(low), vec(low + pane.size * v.size));
    draw.PrimReserve(indices, vertices);
    const auto base = draw._VtxCurrentIdx;
    for (int i = 0; i < indices; ++i) {
      const int index = draw.IdxBuffer[before.indices + i] - before.first + static_cast<int>(base);
      draw.PrimWriteIdx(static_cast<ImDrawIdx>(index));
    }
    for (int i = 0; i < vertices; ++i) {
      const ImDrawVert& vertex = draw.VtxBuffer[before.vertices + i];
      draw.PrimWriteVtx({vertex.pos.x + shift.x, vertex.pos.y + shift.y}, vertex.uv, vertex.col);
    }
    draw.PopClipRect();
  }
}

void split_overlay(const Context& ui) {
  const scene::Workspace& w = ui.workspace;
  if (!w.split.on() || !w.document.model.surface) return;
  for (std::size_t view = 0; view < w.split.count(); ++view) {
    const scene::Pane pane = scene::pane_of(w.split, view);
    frame(ui, pane);
    const float beside = pane.at.x == 0 && w.view.panels ? tools_room : 0;
    const bool by_axes = w.view.axes && pane.at.y == 0 && pane.at.x + pane.size.x > 0.99f;
    caption(ui, view, w.viewport.origin + pane.at * w.viewport.size + glm::vec2(beside, 0),
            pane.size.x * w.viewport.size.x - beside - (by_axes ? axes_room : 0));
  }
  if (w.split.wipes()) wipe_line(ui);
}

}  // namespace viete::ui
