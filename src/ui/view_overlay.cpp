#include "document/checks.h"
#include "interact/cursor_projection.h"
#include "interact/picking.h"
#include "ui/help_overlay.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/command.h"
#include "workspace/pointer.h"

namespace viete::ui {

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
  const auto center =
      interact::Projector(w.document.space(), w.view.camera, w.view.viewport)(*w.view.interaction.brush);
  if (!center) return;
  OverlayPainter painter(ui);
  painter.circle(glm::vec2(*center), w.view.brush.radius, ui.colors.text, 1.25f, 0.9f);
  painter.disc(glm::vec2(*center), 2, ui.colors.text, 0.9f);
}

// Draws a centered line. Returns false if the line does not fit.
bool centered(const Context& ui, float y, const std::string& line, ImU32 color) {
  const char* const text = line.c_str();
  const auto& v = ui.workspace.view.viewport;
  ImGui::PushFont(ui.fonts.text);
  const ImVec2 size = ImGui::CalcTextSize(text);
  const bool fits = size.x + 24 <= v.size.x;
  if (fits)
    ImGui::GetBackgroundDrawList()->AddText({v.origin.x + 0.5f * (v.size.x - size.x), y}, color, text);
  ImGui::PopFont();
  return fits;
}

void editing_hint(const Context& ui) {
  const auto& v = ui.workspace.view.viewport;
  const std::string key = key_or_label(ui.workspace.preferences.keymap, "edit_cage");
  centered(ui, v.origin.y + v.size.y - 34, "Editing the cage at rest     " + key + " returns to posing",
           ui.colors.accent);
}

void hints(const Context& ui) {
  const auto& w = ui.workspace;
  const float y = w.view.viewport.origin.y + w.view.viewport.size.y - 34;
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
  const auto& v = ui.workspace.view.viewport;
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
  const interact::Projector project(w.document.space(), w.view.camera, w.view.viewport);
  OverlayPainter paint(ui);
  for (const auto& [a, b] : document::torn_edges(w.frame.report, *w.document.cage(), most)) {
    const auto from = project(positions[a]), to = project(positions[b]);
    if (from && to) paint.line(glm::vec2(*from), glm::vec2(*to), ui.colors.bad, 2.5f);
  }
}

}  // namespace viete::ui
