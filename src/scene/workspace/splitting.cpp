#include "scene/workspace/splitting.h"

#include <algorithm>
#include <utility>

#include "deform/scheme.h"

namespace viete::scene {

namespace {

// The first deformer that no view uses.
deform::Scheme unused_scheme(const Workspace& w) {
  const auto is_used = [&](const deform::Scheme& scheme) {
    return scheme == w.document.scheme ||
           std::ranges::find(w.split.sides, scheme, &SideView::scheme) != w.split.sides.end();
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
  count = std::clamp<std::size_t>(count, 1, Split::most_sides + 1);
  enter_view(w, 0);
  if (count - 1 < split.sides.size()) split.sides.resize(count - 1);
  while (split.count() < count) {
    split.sides.push_back({SideWay{unused_scheme(w), w.document.method, w.view.field}});
  }
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
  SideWays ways{{}, split.wipe, static_cast<double>(split.line), {}};
  for (const SideView& side : split.sides) ways.sides.push_back(side);
  if (!split.linked)
    for (std::size_t view = 1; view < split.count(); ++view) ways.cameras.push_back(last_camera_of(w, view));
  return ways;
}

lab::Field shown_field(const Workspace& w, const SideView& side) {
  return shown_field(w, side.field, side.scheme);
}

}  // namespace viete::scene
