// The views of one document, each with its own blend, method and colour map.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/field.h"
#include "document/camera.h"
#include "document/view_options.h"
#include "workspace/frame_stats.h"

namespace viete::workspace {

/// A view, and the results of its last frame. The first view shows the document's settings, see shown_way().
struct View : document::SideWay {
  FieldView shown{};
  FrameStats stats{};
  /// Error of the fused frame, or of its initial guess for a stitched model, against double, in diagonals of
  /// the cage; measured in the background; 0 if staged.
  double fused_error = 0;
  std::optional<double> exp_error{};  ///< largest relative error of sampled matrices; nullopt: none used
  bool binding = false;
  std::string problem{};  ///< why it shows no model
};

struct Split {
  static constexpr std::size_t most = document::SideWays::most + 1;

  std::vector<View> views = std::vector<View>(1);
  bool linked = true;                         ///< all views share one camera
  std::size_t active = 0;                     ///< the view with the gizmo and the current camera
  std::vector<document::CameraPose> cameras;  ///< cameras of inactive views, if not linked

  std::size_t count() const { return views.size(); }
  bool on() const { return count() > 1; }
  /// All but the first.
  std::span<View> sides() { return std::span(views).subspan(1); }
  std::span<const View> sides() const { return std::span(views).subspan(1); }
};

/// Position and size of a view as fractions of the whole: offset from the top left.
struct Pane {
  glm::vec2 at{0, 0}, size{1, 1};
};
Pane pane_of(const Split& split, std::size_t view);
/// The viewport of the view's camera.
document::Viewport viewport_of(const Split& split, const document::Viewport& whole, std::size_t view);
/// The view at a position in the window.
std::size_t view_at(const Split& split, const document::Viewport& whole, const glm::vec2& place);

/// Replaces the views and activates the first one.
void put_ways(Split& split, const document::SideWays& ways);

}  // namespace viete::workspace
