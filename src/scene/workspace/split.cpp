#include "scene/workspace/split.h"

namespace viete::scene {

namespace {

// Columns and rows for the number of views.
glm::ivec2 grid_of(std::size_t count) {
  return count == 4 ? glm::ivec2(2, 2) : glm::ivec2(static_cast<int>(count), 1);
}

}  // namespace

Pane pane_of(const Split& split, std::size_t view) {
  if (split.wipes())
    return view == 0 ? Pane{{0, 0}, {split.line, 1}} : Pane{{split.line, 0}, {1 - split.line, 1}};
  const glm::ivec2 grid = grid_of(split.count());
  const int at = static_cast<int>(view);
  const glm::vec2 size = 1.0f / glm::vec2(grid);
  return {size * glm::vec2(at % grid.x, at / grid.x), size};
}

Viewport viewport_of(const Split& split, const Viewport& whole, std::size_t view) {
  Viewport seen = whole;
  const Pane pane = split.wipes() ? Pane{} : pane_of(split, view);
  seen.pane = pane.at, seen.pane_size = pane.size;
  return seen;
}

void put_ways(Split& split, const SideWays& ways) {
  split.sides.clear();
  for (const SideWay& way : ways.sides) split.sides.push_back({way});
  split.wipe = ways.wipe, split.line = static_cast<float>(ways.line);
  split.active = 0;
  if (split.on()) split.linked = ways.cameras.empty();
  split.cameras = ways.cameras;
  if (!split.linked) split.cameras.insert(split.cameras.begin(), CameraPose{});  // for the active view
}

std::size_t view_at(const Split& split, const Viewport& whole, const glm::vec2& place) {
  const glm::vec2 at = (place - whole.origin) / whole.size;
  for (std::size_t view = 0; view < split.count(); ++view) {
    const Pane pane = pane_of(split, view);
    if (glm::all(glm::greaterThanEqual(at, pane.at)) && glm::all(glm::lessThan(at, pane.at + pane.size)))
      return view;
  }
  return split.active;
}

}  // namespace viete::scene
