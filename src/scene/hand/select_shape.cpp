#include "scene/hand/select_shape.h"

namespace viete::scene {

void draw_on(Lasso& lasso, const glm::vec2& to) {
  constexpr float step = 2;
  if (lasso.line.empty() || glm::distance(lasso.line.back(), to) >= step) lasso.line.push_back(to);
}

// The winding number: each side that crosses the level of the point to its right counts by its direction.
bool encloses(std::span<const glm::vec2> line, const glm::vec2& point) {
  int turns = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const glm::vec2 a = line[i], b = line[(i + 1) % line.size()];
    if ((a.y <= point.y) == (b.y <= point.y)) continue;
    const float x = a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x);
    if (x > point.x) turns += b.y > a.y ? 1 : -1;
  }
  return turns != 0;
}

}  // namespace viete::scene
