// The split view: borders between its parts, and their captions.
#include <algorithm>
#include <cfloat>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ui/format.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr float tools_room = 60, axes_room = 112;  // reserved at the edges of the view
constexpr float least_room = 170;  // minimum for a caption next to the axes; otherwise it is at the bottom

// Empty unless some view blends differently (linear or log space) from the document.
std::string blending_words(const scene::Workspace& w, bool other) {
  const auto has_other = [](const scene::SideView& side) { return side.other_blending; };
  if (std::ranges::none_of(w.split.sides, has_other)) return "";
  return w.document.timeline.straight != other ? "linear interpolation" : "log space";
}

// One line if the text fits.
struct Text {
  std::vector<std::string> parts;
  const char* between;
};

struct Caption {
  Text title{{}, " \u00b7 "}, numbers{{}, "   "};
};

void add(Text& text, std::string part) {
  if (!part.empty()) text.parts.push_back(std::move(part));
}

std::string way_words(const scene::Scheme& scheme) {
  const auto way = scene::way_of(scheme);
  return way ? std::string(scene::entry(*way).label) : "Custom";
}

// "1.9 ms", "exp 3e-16", "frame 2e-08".
void add_numbers(Text& text, const scene::FrameStats& stats, std::optional<double> exp_error,
                 double fused_error) {
  if (const auto times = stats.deforming_median()) add(text, milliseconds(times->links.total()));
  if (exp_error) add(text, "exp " + error(*exp_error));
  if (fused_error > 0) add(text, "frame " + error(fused_error));
}

void add_title(Text& text, const scene::Workspace& w, const scene::Scheme& scheme, scene::Method method,
               bool other_blending) {
  if (w.document.has_cage()) {
    add(text, way_words(scheme));
    if (scheme.exponential()) add(text, method_label(method));
  }
  add(text, blending_words(w, other_blending));
}

Caption shown_in(const scene::Workspace& w, std::size_t view) {
  Caption shown;
  if (view == 0) {
    const scene::MethodSample* sample = running_sample(w);
    add_title(shown.title, w, w.document.scheme, w.document.method, false);
    add_numbers(shown.numbers, w.stats, sample ? std::optional(sample->worst_error) : std::nullopt,
                w.fused_error);
    return shown;
  }
  const scene::SideView& side = w.split.sides[view - 1];
  add_title(shown.title, w, side.scheme, side.method, side.other_blending);
  if (!side.problem.empty())
    add(shown.numbers, side.problem);
  else if (side.binding)
    add(shown.numbers, "binding");
  else
    add_numbers(shown.numbers, side.stats, side.exp_error, side.fused_error);
  return shown;
}

struct Line {
  ImFont* font;
  ImU32 color;
  std::string words;
  ImVec2 size;
};

// Parts wider than the room are wrapped at spaces.
void add_lines(std::vector<Line>& lines, ImFont* font, ImU32 color, const Text& text, float room) {
  const float height = font->FontSize * ImGui::GetIO().FontGlobalScale;
  const auto size_of = [&](const std::string& words) {
    return font->CalcTextSizeA(height, FLT_MAX, room, words.c_str());
  };
  const std::size_t first = lines.size();
  for (const std::string& part : text.parts) {
    const bool begins = lines.size() == first;
    const std::string longer = begins ? part : lines.back().words + text.between + part;
    if (begins || size_of(longer).y > 1.5f * height)
      lines.push_back({font, color, part, size_of(part)});
    else
      lines.back().words = longer, lines.back().size = size_of(longer);
  }
}

// At the upper left of its part, or with its lower left corner at `at`.
void caption(const Context& ui, std::size_t view, glm::vec2 at, float room, bool at_bottom) {
  const ImVec2 padding{10, 6};
  const float most = std::max(room - 16 - 2 * padding.x, 1.0f);
  const Caption shown = shown_in(ui.workspace, view);
  std::vector<Line> lines;
  add_lines(lines, ui.fonts.strong, ui.colors.text, shown.title, most);
  add_lines(lines, ui.fonts.numbers, ui.colors.faint, shown.numbers, most);
  if (lines.empty()) return;
  float wide = 0, tall = 0;
  for (const Line& line : lines) wide = std::max(wide, line.size.x), tall += line.size.y;
  const ImVec2 low{at.x + 8, at_bottom ? at.y - tall - 2 * padding.y - 8 : at.y + 8};
  const ImVec2 high{low.x + std::min(wide, most) + 2 * padding.x, low.y + tall + 2 * padding.y};
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddRectFilled(low, high, faded(ui.colors.card, 0.85f), 6);
  draw.PushClipRect(low, high, true);  // a word may be wider than the room
  float y = low.y + padding.y;
  for (const Line& line : lines) {
    draw.AddText(line.font, line.font->FontSize * ImGui::GetIO().FontGlobalScale, {low.x + padding.x, y},
                 line.color, line.words.c_str(), nullptr, most);
    y += line.size.y;
  }
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

// Drags the line of a wipe.
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

// Copies the overlays of the active view to the views with the same camera.
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
    const float room = pane.size.x * w.viewport.size.x - beside;
    const bool at_bottom = by_axes && room - axes_room < least_room;
    const glm::vec2 corner = pane.at + glm::vec2(0, at_bottom ? pane.size.y : 0);
    caption(ui, view, w.viewport.origin + corner * w.viewport.size + glm::vec2(beside, 0),
            room - (by_axes && !at_bottom ? axes_room : 0), at_bottom);
  }
  if (w.split.wipes()) wipe_line(ui);
}

}  // namespace viete::ui
