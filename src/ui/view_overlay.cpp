// Drawing over the view: selection tools, axis widget, brush, hints, folds, and captions of split views.
#include <algorithm>
#include <array>
#include <cfloat>
#include <optional>
#include <string>
#include <vector>

#include "document/checks.h"
#include "interact/cursor_projection.h"
#include "interact/picking.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/command.h"
#include "workspace/pointer.h"

namespace viete::ui {

using document::SelectMode, interact::SelectShape;

SelectMode select_mode() {
  const ImGuiIO& io = ImGui::GetIO();
  return io.KeyShift ? SelectMode::add : io.KeyCtrl ? SelectMode::remove : SelectMode::replace;
}

namespace {

// Draws a plus or minus sign next to the cursor, for adding or removing.
void sign(OverlayPainter& painter, const glm::vec2& at, SelectMode mode, ImU32 color) {
  if (mode == SelectMode::replace) return;
  const glm::vec2 middle = at + glm::vec2(14, 14), across(4, 0), up(0, 4);
  painter.line(middle - across, middle + across, color, 1.5f);
  if (mode == SelectMode::add) painter.line(middle - up, middle + up, color, 1.5f);
}

// The outline has the text colour, because the cage can have the same colour as the tint.
void box_between(const Context& ui, OverlayPainter& painter, const workspace::Interaction::Box& box) {
  const glm::vec2 a = box.corner, b = box.opposite;
  const std::array corners = {a, glm::vec2(b.x, a.y), b, glm::vec2(a.x, b.y)};
  painter.tint(corners, faded(ui.colors.accent, 0.10f));
  painter.line(corners, ui.colors.text, 1, true, 0.8f);
}

// Draws lines across the view through the cursor, where the box will start.
void crosshair(const Context& ui, OverlayPainter& painter, const glm::vec2& at) {
  const auto& v = ui.workspace.view.camera.viewport;
  painter.line({v.origin.x, at.y}, {v.origin.x + v.size.x, at.y}, ui.colors.text, 1, 0.5f);
  painter.line({at.x, v.origin.y}, {at.x, v.origin.y + v.size.y}, ui.colors.text, 1, 0.5f);
}

void lasso_line(const Context& ui, OverlayPainter& painter, const interact::Lasso& lasso) {
  const auto& line = lasso.line;
  if (line.size() < 2) return;
  painter.line(line, ui.colors.text, 1.5f);
  // The closing segment: dashes from the end to the start.
  const glm::vec2 from = line.back(), edge = line.front() - from;
  const float length = glm::length(edge);
  for (float d = 0; d < length; d += 9)
    painter.line(from + edge * (d / length), from + edge * (std::min(d + 5, length) / length), ui.colors.text,
                 1.25f, 0.7f);
}

void circle(const Context& ui, OverlayPainter& painter, const workspace::Interaction& hand,
            const glm::vec2& at) {
  const bool works = hand.brushing.has_value();
  if (works)
    ImGui::GetBackgroundDrawList()->AddCircleFilled(vec(at), hand.select_radius,
                                                    faded(ui.colors.accent, 0.12f));
  painter.circle(at, hand.select_radius, ui.colors.text, 1.5f, works ? 1 : 0.8f);
  painter.disc(at, 1.5f, ui.colors.text);
}

void select_overlay(const Context& ui) {
  const auto& hand = ui.workspace.view.interaction;
  OverlayPainter painter(ui);
  if (hand.lasso) {
    lasso_line(ui, painter, *hand.lasso);
    return sign(painter, hand.lasso->line.back(), hand.lasso->mode, ui.colors.text);
  }
  if (hand.box) {
    box_between(ui, painter, *hand.box);
    return sign(painter, hand.box->opposite, hand.box->mode, ui.colors.text);
  }
  if (!hand.armed || !hand.cursor) return;
  const glm::vec2 at = *hand.cursor;
  switch (*hand.armed) {
    case SelectShape::box: crosshair(ui, painter, at); break;
    case SelectShape::lasso: painter.circle(at, 4, ui.colors.text, 1.5f); break;
    case SelectShape::brush: circle(ui, painter, hand, at); break;
  }
  sign(painter, at, hand.brushing.value_or(select_mode()), ui.colors.text);
}

}  // namespace

std::string select_hint(const workspace::Workspace& w) {
  const auto& hand = w.view.interaction;
  if (hand.box || hand.lasso || hand.brushing) return "Release to select, Esc to cancel";
  if (!hand.armed) return "";
  switch (*hand.armed) {
    case SelectShape::box: return "Box:  drag from anywhere,  Shift adds,  Ctrl removes;  Esc ends";
    case SelectShape::lasso: return "Lasso:  drag around elements,  Shift adds,  Ctrl removes;  Esc ends";
    case SelectShape::brush: break;
  }
  return "Brush:  drag over elements,  Ctrl removes,  wheel changes its size;  Esc ends";
}

namespace {

const char* letter_of(const interact::AxisBall& ball) {
  constexpr const char* letters[2][3] = {{"-X", "-Y", "-Z"}, {"X", "Y", "Z"}};
  return letters[ball.positive ? 1 : 0][ball.axis];
}

// Axes pointing away are fainter.
float opacity(const interact::AxisBall& ball) {
  return 0.75f + 0.25f * ball.nearness;
}

void draw_ball(const Context& ui, OverlayPainter& painter, const interact::AxisBall& ball,
               const glm::vec2& center, bool hovered) {
  const ImU32 color = ui.colors.axis[ball.axis];
  if (ball.positive) {
    painter.line(center, ball.at, color, 2, opacity(ball));
    painter.disc(ball.at, ball.radius, color, opacity(ball));
  } else {
    painter.disc(ball.at, ball.radius, ui.colors.card, 0.9f);
    painter.circle(ball.at, ball.radius - 0.75f, color, 1.5f, hovered ? 1 : 0.8f * opacity(ball));
  }
  if (hovered) painter.circle(ball.at, ball.radius + 1.5f, ui.colors.text, 1.5f);
  if (ball.positive || hovered)
    painter.letter(ball.at, letter_of(ball), ball.positive ? ui.colors.on_axis : ui.colors.text);
}

}  // namespace

void axis_overlay(const Context& ui) {
  const auto widget = workspace::axis_widget_of(ui.workspace);
  if (!widget) return;
  OverlayPainter painter(ui);
  const bool over = ui.workspace.view.interaction.over_axes;
  const ImVec2 cursor = ImGui::GetIO().MousePos;
  const interact::AxisBall* hovered = over ? widget->ball({cursor.x, cursor.y}) : nullptr;
  if (over) painter.disc(widget->center, interact::axes_radius, faded(ui.colors.card, 0.7f), 1);
  for (const auto& ball : widget->balls) draw_ball(ui, painter, ball, widget->center, &ball == hovered);
}

namespace {

// Draws the brush as a circle on the screen, around the brushed point of the model.
void brush_ring(const Context& ui, const workspace::Workspace& w) {
  const auto center = interact::Projector(w.document.space(), w.view.camera)(*w.view.interaction.brush);
  if (!center) return;
  OverlayPainter painter(ui);
  painter.circle(glm::vec2(*center), w.view.brush.radius, ui.colors.text, 1.25f, 0.9f);
  painter.disc(glm::vec2(*center), 2, ui.colors.text, 0.9f);
}

// Draws a centered line. Returns false if the line does not fit.
bool centered(const Context& ui, float y, const std::string& line, ImU32 color) {
  const char* const text = line.c_str();
  const auto& v = ui.workspace.view.camera.viewport;
  ImGui::PushFont(ui.fonts.text);
  const ImVec2 size = ImGui::CalcTextSize(text);
  const bool fits = size.x + 24 <= v.size.x;
  if (fits)
    ImGui::GetBackgroundDrawList()->AddText({v.origin.x + 0.5f * (v.size.x - size.x), y}, color, text);
  ImGui::PopFont();
  return fits;
}

void editing_hint(const Context& ui) {
  const auto& v = ui.workspace.view.camera.viewport;
  const std::string key = key_or_label(ui.workspace.preferences.keymap, "edit_cage");
  centered(ui, v.origin.y + v.size.y - 34, "Editing the cage at rest     " + key + " returns to posing",
           ui.colors.accent);
}

void hints(const Context& ui) {
  const auto& w = ui.workspace;
  const float y = w.view.camera.viewport.origin.y + w.view.camera.viewport.size.y - 34;
  const ImU32 color = faded(ui.colors.text, 0.75f);
  const std::string space = workspace::text(w.preferences.keymap.of(*workspace::find_command("play")).first);
  const std::string help = key_or_label(w.preferences.keymap, "help");
  const std::string plays =
      !w.document.timeline().has_poses() || space.empty() ? "" : "     " + space + " plays it";
  for (const char* method : {"     Switch the method in the right column", ""}) {
    const std::string text =
        "Drag a vertex of the cage" + plays + method + "     " + help + " shows every key";
    if (centered(ui, y, text, color)) return;
  }
}

void restore_hint(const Context& ui) {
  const workspace::Command& command = *workspace::find_command("toggle_panels");
  const auto& v = ui.workspace.view.camera.viewport;
  centered(ui, v.origin.y + v.size.y - 28,
           workspace::text(ui.workspace.preferences.keymap.of(command).first) + " shows the panels again",
           faded(ui.colors.text, 0.5f));
}

}  // namespace

void view_overlay(const Context& ui) {
  const auto& w = ui.workspace;
  select_overlay(ui);
  auto& options = w.view.options;
  if (!options.panels && w.panels.has_user) restore_hint(ui);
  if (w.view.interaction.brush) brush_ring(ui, w);
  if (w.jobs.working()) return;  // the progress bar needs this place
  if (w.document.kept_pose() && options.panels) return editing_hint(ui);
  const bool room =  // false if the legend, the brush or the next step needs the place
      workspace::shown_field(w) == analysis::Field::none && !workspace::shows_mask(w) &&
      !workspace::offers_next_step(w);
  if (options.hints && room && w.document.has_cage() && options.panels && !w.view.interaction.drag) hints(ui);
}

void torn_overlay(const Context& ui) {
  const auto& w = ui.workspace;
  if (!w.view.options.cage || !w.document.has_cage()) return;
  constexpr std::size_t most = 200;
  const auto& positions = w.document.pose().positions;
  const interact::Projector project(w.document.space(), w.view.camera);
  OverlayPainter paint(ui);
  for (const auto& [a, b] : document::torn_edges(w.frame.report, *w.document.cage(), most)) {
    const auto from = project(positions[a]), to = project(positions[b]);
    if (from && to) paint.line(glm::vec2(*from), glm::vec2(*to), ui.colors.bad, 2.5f);
  }
}

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

void frame(const Context& ui, const document::Viewport& v) {
  const glm::vec2 low = glm::round(v.low()), high = glm::round(v.high());
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  if (v.pane.x > 0) draw.AddLine({low.x, low.y}, {low.x, high.y}, ui.colors.line, 1.5f);
  if (v.pane.y > 0) draw.AddLine({low.x, low.y}, {high.x, low.y}, ui.colors.line, 1.5f);
}

}  // namespace

void split_overlay(const Context& ui) {
  const workspace::Workspace& w = ui.workspace;
  if (!w.view.split.on() || !w.document.model().surface) return;
  for (std::size_t view = 0; view < w.view.split.count(); ++view) {
    const document::Viewport v = workspace::viewport_of(w.view.split, w.view.camera.viewport, view);
    frame(ui, v);
    const float beside = v.pane.x == 0 && w.view.options.panels ? tools_room : 0;
    const bool by_axes = w.view.options.axes && v.pane.y == 0 && v.pane.x + v.pane_size.x > 0.99f;
    const float room = v.seen().x - beside;
    const bool at_bottom = by_axes && room - axes_room < least_room;
    const glm::vec2 corner(v.low().x, at_bottom ? v.high().y : v.low().y);
    const bool over_legend = at_bottom && workspace::shown_field(w, view) != analysis::Field::none;
    const glm::vec2 offset(beside, over_legend ? -tiny_legend_height : 0);
    caption(ui, view, corner + offset, room - (by_axes && !at_bottom ? axes_room : 0), at_bottom);
  }
}

}  // namespace viete::ui
