#include <algorithm>
#include <array>
#include <string>

#include "ui/overlay_painter.h"
#include "ui/panels.h"

namespace viete::ui {

namespace {

using document::SelectMode, interact::SelectShape;

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
  const auto& v = ui.workspace.view.viewport;
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

}  // namespace

SelectMode select_mode() {
  const ImGuiIO& io = ImGui::GetIO();
  return io.KeyShift ? SelectMode::add : io.KeyCtrl ? SelectMode::remove : SelectMode::replace;
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

}  // namespace viete::ui
