// The split view: several views of one document with their own blend, method and colour map.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lab/field.h"
#include "scene/document/camera.h"
#include "scene/document/view_options.h"
#include "scene/workspace/frame_stats.h"

namespace viete::scene {

/// An additional view.
struct SideView : SideWay {
  // Results of the last frame.
  FieldView shown{};
  FrameStats stats{};
  double fused_error = 0;             ///< see Workspace::fused_error
  std::optional<double> exp_error{};  ///< largest relative error of sampled matrices; nullopt: it uses none
  bool binding = false;
  std::string problem{};  ///< why it shows no model
};

struct Split {
  static constexpr std::size_t most_sides = SideWays::most;
  static constexpr auto least_part = static_cast<float>(SideWays::least_part);

  std::vector<SideView> sides;      ///< empty: a single view
  bool wipe = false;                ///< two views in one place, separated by a movable line
  float line = 0.5f;                ///< position as a fraction of the width, least_part to 1 - least_part
  bool linked = true;               ///< all views share one camera
  std::size_t active = 0;           ///< the view with the gizmo and the current camera; 0 is the first one
  std::vector<CameraPose> cameras;  ///< cameras of inactive views, if not linked

  std::size_t count() const { return sides.size() + 1; }
  bool on() const { return !sides.empty(); }
  bool wipes() const { return wipe && sides.size() == 1; }
};

/// Position and size of a view as fractions of the whole: offset from the top left.
struct Pane {
  glm::vec2 at{0, 0}, size{1, 1};
};
/// The visible part: with a wipe, one side of the line.
Pane pane_of(const Split& split, std::size_t view);
/// The viewport of the view's camera: with a wipe, the whole.
Viewport viewport_of(const Split& split, const Viewport& whole, std::size_t view);
/// The view at a position in the window.
std::size_t view_at(const Split& split, const Viewport& whole, const glm::vec2& place);

/// Replaces the views and activates the first one.
void put_ways(Split& split, const SideWays& ways);

}  // namespace viete::scene
