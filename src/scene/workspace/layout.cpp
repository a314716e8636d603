#include "scene/workspace/layout.h"

#include <algorithm>

namespace viete::scene {

namespace {

constexpr std::size_t index(Column column) {
  return static_cast<std::size_t>(column);
}

constexpr Column other(Column column) {
  return column == Column::tools ? Column::methods : Column::tools;
}

// As wide as it was made, or as there is room.
float fitted(float width, float room) {
  return std::min(width, std::max(PanelLayout::least_width, room));
}

}  // namespace

ColumnWidths shown_columns(const PanelLayout& layout, float window_width) {
  const float room = window_width - PanelLayout::least_view;
  const bool both = !layout.folded[0] && !layout.folded[1] && room >= 2 * PanelLayout::least_width;
  std::array<float, 2> shown{};
  for (const Column column : {layout.last, other(layout.last)}) {
    const bool alone = column == layout.last || layout.is_folded(other(column));
    if (layout.is_folded(column) || !(both || alone)) continue;
    const float taken = shown[index(other(column))];
    const float kept = both && column == layout.last ? PanelLayout::least_width : taken;  // for the other
    shown[index(column)] = fitted(layout.width[index(column)], room - kept);
  }
  return {shown[0], shown[1]};
}

float column_height(const Viewport& viewport) {
  return std::max(1.0f, viewport.window.y - viewport.origin.y - PanelLayout::status_height);
}

Viewport view_between(const PanelLayout& layout, const glm::vec2& window, bool panels, float notice) {
  if (!panels) return {window, {0, notice}, glm::max(glm::vec2(1), window - glm::vec2(0, notice))};
  const ColumnWidths columns = shown_columns(layout, window.x);
  const float below = PanelLayout::status_height + (layout.timeline ? PanelLayout::timeline_height : 0);
  const float above = PanelLayout::menu_height + notice;
  const glm::vec2 covered(columns.tools + columns.methods, above + below);
  return {window, {columns.tools, above}, glm::max(glm::vec2(1), window - covered)};
}

void toggle_column(PanelLayout& layout, Column column, float window_width) {
  const bool shown = shown_columns(layout, window_width).of(column) > 0;
  layout.folded[index(column)] = shown;
  layout.last = shown ? other(column) : column;
}

void set_width(PanelLayout& layout, Column column, float width, float window_width) {
  const float taken = shown_columns(layout, window_width).of(other(column));
  const float room = std::max(PanelLayout::least_width, window_width - taken - PanelLayout::least_view);
  layout.width[index(column)] =
      std::clamp(width, PanelLayout::least_width, std::min(room, PanelLayout::largest_width));
}

}  // namespace viete::scene
