// The view split in several: one document, each view blended, computed and coloured in a way of its own.
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

/// A view beside the first one.
struct SideView : SideWay {
  // What was made of it, by the last frame.
  FieldView shown{};
  FrameStats stats{};
  double fused_error = 0;             ///< see Workspace::fused_error
  std::optional<double> exp_error{};  ///< the worst of some of its matrices, relative; nothing: none are used
  bool binding = false;
  std::string problem{};  ///< why there is none
};

struct Split {
  static constexpr std::size_t most_sides = SideWays::most;
  static constexpr auto least_part = static_cast<float>(SideWays::least_part);

  std::vector<SideView> sides;      ///< none: the view is whole
  bool wipe = false;                ///< two views in one place, on either side of a line
  float line = 0.5f;                ///< where that is, as a part of the width, least_part to 1 - least_part
  bool linked = true;               ///< all have the same camera
  std::size_t active = 0;           ///< the view that the hand works in: 0 is the first one
  std::vector<CameraPose> cameras;  ///< of views that the hand has left, where they are not linked

  std::size_t count() const { return sides.size() + 1; }
  bool on() const { return !sides.empty(); }
  bool wipes() const { return wipe && sides.size() == 1; }
};

/// Where a view stands, as parts of the whole: from the left and the top, and how wide and high.
struct Pane {
  glm::vec2 at{0, 0}, size{1, 1};
};
/// What is seen of it: of a wipe one side of the line.
Pane pane_of(const Split& split, std::size_t view);
/// As the camera sees it: of a wipe all of it.
Viewport viewport_of(const Split& split, const Viewport& whole, std::size_t view);
/// The view under a place of the window.
std::size_t view_at(const Split& split, const Viewport& whole, const glm::vec2& place);

/// The same with these, and the hand in the first one.
void put_ways(Split& split, const SideWays& ways);

}  // namespace viete::scene
