// The axis widget at the top right of the view.
#include "scene/workspace/pointer.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"

namespace viete::ui {

namespace {

const char* letter_of(const scene::AxisBall& ball) {
  constexpr const char* letters[2][3] = {{"-X", "-Y", "-Z"}, {"X", "Y", "Z"}};
  return letters[ball.positive ? 1 : 0][ball.axis];
}

// What points away is fainter.
float opacity(const scene::AxisBall& ball) {
  return 0.75f + 0.25f * ball.nearness;
}

void draw_ball(const Context& ui, OverlayPainter& painter, const scene::AxisBall& ball,
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
  const auto widget = scene::axis_widget_of(ui.workspace);
  if (!widget) return;
  OverlayPainter painter(ui);
  const bool over = ui.workspace.interaction.over_axes;
  const ImVec2 cursor = ImGui::GetIO().MousePos;
  const scene::AxisBall* hovered = over ? widget->ball({cursor.x, cursor.y}) : nullptr;
  if (over) painter.disc(widget->center, scene::axes_radius, faded(ui.colors.card, 0.7f), 1);
  for (const auto& ball : widget->balls) draw_ball(ui, painter, ball, widget->center, &ball == hovered);
}

}  // namespace viete::ui
