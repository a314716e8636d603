// The views of one document, each with its own deformer, method and map.
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

/// A view, and the results of its last picture. The first view has the document's settings, see
/// view_settings().
struct SplitView : document::SideView {
  FieldView shown{};
  FrameStats stats{};
  /// Error of the positions in single precision, relative to the diagonal of the cage. Does not include
  /// errors of stitching. 0 if positions are computed in double precision.
  double fused_error = 0;
  std::optional<double> exp_error{};  ///< largest relative error of sampled exponentials, if there are any
  bool binding = false;
  std::string problem{};  ///< why the view shows no model
};

struct Split {
  static constexpr std::size_t most = document::SideViews::most + 1;

  std::vector<SplitView> views = std::vector<SplitView>(1);
  bool linked = true;                          ///< all views share one camera
  std::size_t active = 0;                      ///< the view with the gizmo and the current camera
  std::vector<document::CameraPose> cameras;   ///< if not linked: one per view; unused for the active view
  std::optional<document::CameraPose> before;  ///< the camera before the view was split

  std::size_t count() const { return views.size(); }
  bool on() const { return count() > 1; }
  /// All views except the first.
  std::span<SplitView> sides() { return std::span(views).subspan(1); }
  std::span<const SplitView> sides() const { return std::span(views).subspan(1); }
};

/// Position (from the top left) and size of a view, as fractions of the whole.
struct Pane {
  glm::vec2 at{0, 0}, size{1, 1};
};
Pane pane_of(const Split& split, std::size_t view);
document::Viewport viewport_of(const Split& split, const document::Viewport& whole, std::size_t view);
/// The view at a position in the window.
std::size_t view_at(const Split& split, const document::Viewport& whole, const glm::vec2& place);

/// Replaces the views and activates the first view.
void put_side_views(Split& split, const document::SideViews& sides);

}  // namespace viete::workspace
