#include "workspace/split.h"

namespace viete::workspace {

Pane pane_of(const Split& split, std::size_t view) {
  const glm::ivec2 grid = split.count() == 4 ? glm::ivec2(2, 2) : glm::ivec2(int(split.count()), 1);
  const int at = static_cast<int>(view);
  const glm::vec2 size = 1.0f / glm::vec2(grid);
  return {size * glm::vec2(at % grid.x, at / grid.x), size};
}

document::Viewport viewport_of(const Split& split, const document::Viewport& whole, std::size_t view) {
  document::Viewport seen = whole;
  const Pane pane = pane_of(split, view);
  seen.pane = pane.at;
  seen.pane_size = pane.size;
  return seen;
}

void put_side_views(Split& split, const document::SideViews& sides) {
  split.views.resize(1);
  for (const document::SideView& side : sides.sides) split.views.push_back({side});
  split.active = 0;
  split.before.reset();
  if (split.on()) split.linked = sides.cameras.empty();
  split.cameras = sides.cameras;
  if (!split.linked)
    split.cameras.insert(split.cameras.begin(), document::CameraPose{});  // for the active view; unused
}

std::size_t view_at(const Split& split, const document::Viewport& whole, const glm::vec2& place) {
  const glm::vec2 at = (place - whole.origin) / whole.size;
  for (std::size_t view = 0; view < split.count(); ++view) {
    const Pane pane = pane_of(split, view);
    if (glm::all(glm::greaterThanEqual(at, pane.at)) && glm::all(glm::lessThan(at, pane.at + pane.size)))
      return view;
  }
  return split.active;
}

}  // namespace viete::workspace
