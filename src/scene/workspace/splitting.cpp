// Splitting the view of a workspace, and switching between its parts.
#include <algorithm>

#include "deform/scheme.h"
#include "scene/workspace/workspace.h"

namespace viete::scene {

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
