// Where the columns of panels stand beside the view, which are folded away, and which sections are open.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <string>

#include "scene/document/camera.h"

namespace viete::scene {

/// The columns: tools at the left; methods, their timings and the deformer at the right.
enum class Column { tools, methods };

/// Logical pixels. As a person has arranged it; what of it there is room for is shown.
struct PanelLayout {
  static constexpr float least_width = 288, usual_width = 320, largest_width = 560;
  static constexpr float least_view = 320;  ///< which is left between the columns
  static constexpr float menu_height = 26, status_height = 26, timeline_height = 156;

  std::array<float, 2> width{usual_width, usual_width};
  std::array<bool, 2> folded{};
  Column last = Column::methods;         ///< unfolded last: shown where there is room for one
  bool timeline = false;                 ///< below the view, between the columns
  std::map<std::string, bool> sections;  ///< by title, of those that were opened or closed: open?

  bool is_folded(Column column) const { return folded[static_cast<std::size_t>(column)]; }

  friend bool operator==(const PanelLayout&, const PanelLayout&) = default;
};

/// As wide as they are shown in a window; 0: not at all.
struct ColumnWidths {
  float tools = 0, methods = 0;
  float of(Column column) const { return column == Column::tools ? tools : methods; }
};
ColumnWidths shown_columns(const PanelLayout& layout, float window_width);

/// From the top of the view to the status bar.
float column_height(const Viewport& viewport);

/// What columns, bars and timeline leave of a window, below a row of notices of this height. Without panels
/// there is only that row.
Viewport view_between(const PanelLayout& layout, const glm::vec2& window, bool panels, float notice = 0);

/// Shows a column that is not shown, if need be instead of the other; folds away one that is.
void toggle_column(PanelLayout& layout, Column column, float window_width);

/// Within the limits, and so that the view keeps its least width.
void set_width(PanelLayout& layout, Column column, float width, float window_width);

}  // namespace viete::scene
