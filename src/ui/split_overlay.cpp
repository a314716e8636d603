// The borders and captions of a split view.
#include <algorithm>
#include <cfloat>
#include <optional>
#include <string>
#include <vector>

#include "ui/format.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr float tools_room = 60, axes_room = 112;  // reserved at the edges of the view
constexpr float least_room = 170;  // if there is less room beside the axes, the caption is at the bottom

// The interpolation of a view. Empty if all views use the same interpolation.
std::string blending_words(const workspace::Workspace& w, bool other) {
  if (std::ranges::none_of(w.view.split.sides(), &workspace::SplitView::other_blending)) return "";
  return w.document.timeline().linear != other ? "linear interpolation" : "log space";
}

struct Caption {
  std::string title;
  std::vector<std::string> numbers;

  void add_title(const std::string& part) {
    title += (title.empty() || part.empty() ? "" : " \u00b7 ") + part;
  }
};

std::string deformer_words(const document::Deformer& deformer) {
  const auto preset = document::preset_of(deformer);
  return preset ? std::string(base::entry_of(*preset).label) : "Custom";
}

// The caption of a view, with numbers such as "1.9 ms", "exp 3e-16", "frame 2e-8".
Caption shown_in(const workspace::Workspace& w, std::size_t number) {
  const document::SideView settings = workspace::view_settings(w, number);
  const workspace::SplitView& view = w.view.split.views[number];
  Caption shown;
  if (w.document.has_cage()) {
    shown.add_title(deformer_words(settings.deformer));
    if (settings.deformer.exponential()) shown.add_title(method_label(settings.method));
  }
  shown.add_title(blending_words(w, settings.other_blending));
  if (!view.problem.empty() || view.binding) {
    shown.numbers.push_back(view.problem.empty() ? "binding" : view.problem);
    return shown;
  }
  if (const auto times = view.stats.deforming_median()) {
    const double bar = w.frame.method_times.stages[workspace::running_times(w)].total();
    shown.numbers.push_back(
        milliseconds(number == 0 && bar > 0 ? bar : times->stages.total()));  // as in Timings
  }
  const workspace::MethodSample* running = number == 0 ? running_sample(w) : nullptr;
  if (const auto exp = running ? std::optional(running->worst_error) : view.exp_error)
    shown.numbers.push_back("exp " + rough_error(*exp));
  if (view.fused_error > 0) shown.numbers.push_back("frame " + rough_error(view.fused_error));
  return shown;
}

// Joins the numbers, as many in a line as fit.
std::string in_lines(const Context& ui, const std::vector<std::string>& numbers, float width) {
  std::string text, line;
  ImGui::PushFont(ui.fonts.numbers);
  for (const std::string& number : numbers) {
    const std::string longer = line.empty() ? number : line + "   " + number;
    const bool fits = line.empty() || ImGui::CalcTextSize(longer.c_str()).x <= width;
    if (!fits) text += line + '\n';
    line = fits ? longer : number;
  }
  ImGui::PopFont();
  return text + line;
}

// Draws a view's caption with its upper or lower left corner near `at`. Text wider than `room` is wrapped.
void caption(const Context& ui, std::size_t view, glm::vec2 at, float room, bool at_bottom) {
  const ImVec2 padding{10, 6};
  const float most = std::max(room - 16 - 2 * padding.x, 1.0f);
  const Caption shown = shown_in(ui.workspace, view);
  const std::string in_view = in_lines(ui, shown.numbers, most);
  const auto height_of = [](ImFont* font) {
    ImGui::PushFont(font);
    const float height = ImGui::GetFontSize();
    ImGui::PopFont();
    return height;
  };
  const auto size_of = [&](ImFont* font, const std::string& words) {
    return words.empty() ? ImVec2(0, 0) : font->CalcTextSizeA(height_of(font), FLT_MAX, most, words.c_str());
  };
  const ImVec2 title = size_of(ui.fonts.strong, shown.title), numbers = size_of(ui.fonts.numbers, in_view);
  const float wide = std::max(title.x, numbers.x), tall = title.y + numbers.y;
  if (tall == 0) return;
  const ImVec2 low{at.x + 8, at_bottom ? at.y - tall - 2 * padding.y - 8 : at.y + 8};
  const ImVec2 high{low.x + std::min(wide, most) + 2 * padding.x, low.y + tall + 2 * padding.y};
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddRectFilled(low, high, faded(ui.colors.card, 0.85f), 6);
  draw.PushClipRect(low, high, true);  // a word may be wider than the room
  const auto put = [&](ImFont* font, ImU32 color, const std::string& words, float below) {
    draw.AddText(font, height_of(font), {low.x + padding.x, low.y + padding.y + below}, color, words.c_str(),
                 nullptr, most);
  };
  put(ui.fonts.strong, ui.colors.text, shown.title, 0);
  put(ui.fonts.numbers, ui.colors.faint, in_view, title.y);
  draw.PopClipRect();
}

void frame(const Context& ui, const workspace::Pane& pane) {
  const document::Viewport& v = ui.workspace.view.viewport;
  const glm::vec2 low = glm::round(v.origin + pane.at * v.size);
  const glm::vec2 high = glm::round(v.origin + (pane.at + pane.size) * v.size);
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  if (pane.at.x > 0) draw.AddLine({low.x, low.y}, {low.x, high.y}, ui.colors.line, 1.5f);
  if (pane.at.y > 0) draw.AddLine({low.x, low.y}, {high.x, low.y}, ui.colors.line, 1.5f);
}

}  // namespace

void split_overlay(const Context& ui) {
  const workspace::Workspace& w = ui.workspace;
  if (!w.view.split.on() || !w.document.model().surface) return;
  for (std::size_t view = 0; view < w.view.split.count(); ++view) {
    const workspace::Pane pane = workspace::pane_of(w.view.split, view);
    frame(ui, pane);
    const float beside = pane.at.x == 0 && w.view.options.panels ? tools_room : 0;
    const bool by_axes = w.view.options.axes && pane.at.y == 0 && pane.at.x + pane.size.x > 0.99f;
    const float room = pane.size.x * w.view.viewport.size.x - beside;
    const bool at_bottom = by_axes && room - axes_room < least_room;
    const glm::vec2 corner = pane.at + glm::vec2(0, at_bottom ? pane.size.y : 0);
    const bool over_legend = at_bottom && workspace::shown_field(w, view) != analysis::Field::none;
    const glm::vec2 offset(beside, over_legend ? -tiny_legend_height : 0);
    caption(ui, view, w.view.viewport.origin + corner * w.view.viewport.size + offset,
            room - (by_axes && !at_bottom ? axes_room : 0), at_bottom);
  }
}

}  // namespace viete::ui
