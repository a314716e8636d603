// Where each named widget was drawn in the last frame: how tests find what a person would click.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace viete::ui {

/// Logical pixels from the top left of the window.
struct WidgetRect {
  float x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool visible = false;  ///< false when scrolled or clipped away
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

}  // namespace viete::ui
