#include "scene/workspace/split.h"

#include <algorithm>

#include "deform/scheme.h"
#include "scene/workspace/workspace.h"

namespace viete::scene {

namespace {

// Columns and rows for the number of views.
glm::ivec2 grid_of(std::size_t count) {
  return count == 4 ? glm::ivec2(2, 2) : glm::ivec2(static_cast<int>(count), 1);
}

}  // namespace

Pane pane_of(const Split& split, std::size_t view) {
  const glm::ivec2 grid = grid_of(split.count());
  const int at = static_cast<int>(view);
  const glm::vec2 size = 1.0f / glm::vec2(grid);
  return {size * glm::vec2(at % grid.x, at / grid.x), size};
}

Viewport viewport_of(const Split& split, const Viewport& whole, std::size_t view) {
  Viewport seen = whole;
  const Pane pane = pane_of(split, view);
  seen.pane = pane.at, seen.pane_size = pane.size;
  return seen;
}

void put_ways(Split& split, const SideWays& ways) {
  split.views.resize(1);
  for (const SideWay& way : ways.sides) split.views.push_back({way});
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

namespace {

// The first deformer that no view uses.
deform::Scheme unused_scheme(const Workspace& w) {
  const auto is_used = [&](const deform::Scheme& scheme) {
    for (std::size_t view = 0; view < w.split.count(); ++view)
      if (shown_way(w, view).scheme == scheme) return true;
    return false;
  };
  for (const deform::WayEntry& entry : deform::all_ways()) {
    const deform::Scheme scheme = deform::scheme_of(entry.value, w.document.scheme);
    if (!is_used(scheme)) return scheme;
  }
  return w.document.scheme;
}

}  // namespace

void split_view(Workspace& w, std::size_t count) {
  Split& split = w.split;
  count = std::clamp<std::size_t>(count, 1, Split::most);
  enter_view(w, 0);
  split.views.resize(std::min(count, split.count()));
  while (split.count() < count) split.views.push_back({{unused_scheme(w), w.document.method, w.view.field}});
  split.cameras.assign(split.count(), w.camera.pose());
  w.viewport = viewport_of(split, w.viewport, 0);
}

void enter_view(Workspace& w, std::size_t view) {
  Split& split = w.split;
  if (view == split.active || view >= split.count()) return;
  split.cameras.resize(split.count(), w.camera.pose());
  if (!split.linked) {
    split.cameras[split.active] = w.camera.pose();
    w.camera.set_pose(split.cameras[view]);
  }
  split.active = view;
  w.viewport = viewport_of(split, w.viewport, view);
}

CameraPose camera_of(const Workspace& w, std::size_t view) {
  const Split& split = w.split;
  const bool own = !split.linked && view != split.active && view < split.cameras.size();
  return own ? split.cameras[view] : w.camera.pose();
}

CameraPose last_camera_of(const Workspace& w, std::size_t view) {
  return w.split.linked || view == w.split.active ? w.camera.destination() : camera_of(w, view);
}

SideWays ways_of(const Workspace& w) {
  const Split& split = w.split;
  SideWays ways;
  for (const View& side : split.sides()) ways.sides.push_back(side);
  if (!split.linked)
    for (std::size_t view = 1; view < split.count(); ++view) ways.cameras.push_back(last_camera_of(w, view));
  return ways;
}

}  // namespace viete::scene
