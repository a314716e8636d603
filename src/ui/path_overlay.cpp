// The ways of the selected vertices of the cage through all keys: in log space, and in a straight line.
#include <vector>

#include "scene/hand/picking.h"
#include "scene/hand/projector.h"
#include "scene/workspace/motion_path.h"
#include "scene/workspace/playing.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"

namespace viete::ui {

namespace {

// As one line, or only every other piece of it.
void way(OverlayPainter& painter, const scene::Projector& project, const scene::MotionPath::Places& places,
         ImU32 color, bool dashed) {
  std::vector<glm::vec2> line;
  const auto draw = [&] {
    if (line.size() > 1) painter.line(line, color, dashed ? 1.25f : 2.0f);
    line.clear();
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto at = project(places[i]);
    if (!at) {
      draw();
      continue;
    }
    line.emplace_back(*at);
    if (!dashed) continue;
    if (line.size() == 2) draw();
  }
  draw();
}

}  // namespace

void path_overlay(const Context& ui) {
  scene::Workspace& w = ui.workspace;
  if (!w.playback.paths || !w.view.cage || w.document.timeline.keys.size() < 2) return;
  const scene::MotionPaths& paths = w.paths.of(w.document, scene::animation_of(w));
  if (paths.paths.empty()) return;
  const scene::Projector project(w.document.space, w.camera, w.viewport);
  OverlayPainter painter(ui);
  for (const scene::MotionPath& path : paths.paths) {
    way(painter, project, path.straight, ui.colors.neutral, true);
    way(painter, project, path.by_logs, ui.colors.accent, false);
    for (const std::size_t key : paths.keys)
      if (const auto at = project(path.by_logs[key])) painter.disc(glm::vec2(*at), 3, ui.colors.accent);
  }
}

}  // namespace viete::ui
