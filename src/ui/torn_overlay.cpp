// Marks at the cage where the mesh may fold.
#include "scene/document/checks.h"
#include "scene/hand/cursor_projection.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"

namespace viete::ui {

void torn_overlay(const Context& ui) {
  const auto& w = ui.workspace;
  if (!w.view.cage || !w.document.has_cage()) return;
  constexpr std::size_t most = 200;
  const auto& positions = w.document.pose.positions;
  const scene::Projector project(w.document.space, w.camera, w.viewport);
  OverlayPainter paint(ui);
  for (const auto& [a, b] : scene::torn_edges(w.pose_report, *w.document.cage, most)) {
    const auto from = project(positions[a]), to = project(positions[b]);
    if (from && to) paint.line(glm::vec2(*from), glm::vec2(*to), ui.colors.bad, 2.5f);
  }
}

}  // namespace viete::ui
