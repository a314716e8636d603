// What a hand draws over the view to select what is within: a box, a lasso, or the circle of a brush.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/document/selection.h"

namespace viete::scene {

enum class SelectShape { box, lasso, brush };

/// The circle of the brush follows the cursor.
inline constexpr float least_select_radius = 4, largest_select_radius = 400;  ///< logical pixels

/// In logical pixels; closed from its end to its start.
struct Lasso {
  std::vector<glm::vec2> line;
  SelectMode mode;
};

/// Takes the next place of the cursor, where it is far enough from the last one to be seen.
void draw_on(Lasso& lasso, const glm::vec2& to);
/// True if the closed line goes round the point, however it crosses itself.
bool encloses(std::span<const glm::vec2> line, const glm::vec2& point);

}  // namespace viete::scene
