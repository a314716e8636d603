// The context of every panel: workspace, fonts, theme, and a widget recorder for tests.
#pragma once

#include <imgui.h>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "workspace/workspace.h"

namespace viete::ui {

/// The rectangle of a widget, in logical pixels from the top left of the window.
struct WidgetRect {
  float x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool visible = false;  ///< false if scrolled out of view or clipped
  bool enabled = true;
};

class Recorder {
public:
  void begin_frame() { widgets_.clear(); }
  void add(const std::string& name, const WidgetRect& rect) { widgets_[name] = rect; }
  std::optional<WidgetRect> find(const std::string& name) const {
    const auto found = widgets_.find(name);
    return found == widgets_.end() ? std::nullopt : std::optional(found->second);
  }
  const std::map<std::string, WidgetRect>& all() const { return widgets_; }

private:
  std::map<std::string, WidgetRect> widgets_;
};

/// A null font means ImGui's default font.
struct Fonts {
  ImFont* text = nullptr;
  ImFont* strong = nullptr;
  ImFont* numbers = nullptr;                   ///< with digits of equal width
  std::vector<std::vector<ImWchar>> ranges{};  ///< the glyph ranges, which ImGui's atlas refers to
};

/// Colours that ImGui's style does not include.
struct Palette {
  ImU32 text, faint, accent, good, warn, bad, card, card_hover, card_active, line;
  ImU32 model;                     ///< the model in small pictures
  ImU32 axis[3], on_axis;          ///< colours of the three axes, and of letters on an axis
  ImU32 neutral, highlight, halo;  ///< gizmo handle without axis, hovered handle, outline
};

Palette palette(bool dark);

/// Colours for increasing values of a map. Maps of signed values use `diverging`. Other maps use `even`.
struct FieldColors {
  std::vector<ImU32> even, diverging;
};

struct Context {
  workspace::Workspace& workspace;
  const Fonts& fonts;
  Palette colors;
  Recorder* recorder;  ///< null: not recording
  const FieldColors& field_colors;
};

inline constexpr float status_height = workspace::PanelLayout::status_height;

ImU32 stage_color(workspace::Stage stage);

}  // namespace viete::ui
