// What goes along with the selection, in the view: partners in the mirror, the radius, the placed pivot.
#include <cmath>
#include <vector>

#include "scene/document/selection_sets.h"
#include "scene/hand/cursor_projection.h"
#include "scene/hand/picking.h"
#include "scene/hand/transform.h"
#include "scene/workspace/pivot_place.h"
#include "scene/workspace/pointer.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"

namespace viete::ui {

namespace {

void cross(const Context& ui, OverlayPainter& painter, const glm::vec2& at, ImU32 color) {
  constexpr float inner = 4, outer = 11;
  for (const glm::vec2 way : {glm::vec2(1, 0), glm::vec2(-1, 0), glm::vec2(0, 1), glm::vec2(0, -1)})
    painter.line(at + inner * way, at + outer * way, color, 1.5f);
  painter.circle(at, 7, color, 1.25f);
  painter.disc(at, 1.5f, ui.colors.text);
}

void placed_pivot(const Context& ui, OverlayPainter& painter, const scene::Projector& project) {
  const scene::Workspace& w = ui.workspace;
  if (w.interaction.placing_pivot && w.interaction.cursor) {
    if (const auto at = project(scene::pivot_place(w, *w.interaction.cursor)))
      cross(ui, painter, glm::vec2(*at), ui.colors.highlight);
    return;
  }
  if (w.handling.pivot != scene::Pivot::point || !w.handling.point) return;
  if (const auto at = project(*w.handling.point)) cross(ui, painter, glm::vec2(*at), ui.colors.neutral);
}

// Lines between partners; those on the plane, and those without one, are marked by themselves.
void partner_map(const Context& ui, OverlayPainter& painter, const scene::Projector& project,
                 const scene::Mirror& mirror) {
  const auto& positions = ui.workspace.document.pose.positions;
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    const auto at = project(positions[v]);
    if (!at || mirror.partners[v] < v) continue;
    if (mirror.partners[v] == scene::Mirror::none) {
      painter.circle(glm::vec2(*at), 8, ui.colors.bad, 1.5f);
    } else if (mirror.is_on_plane(v)) {
      painter.circle(glm::vec2(*at), 6, ui.colors.highlight, 1.25f);
    } else if (const auto other = project(positions[mirror.partners[v]])) {
      painter.line(glm::vec2(*at), glm::vec2(*other), ui.colors.highlight, 1, 0.5f);
    }
  }
}

// Of the selection: rings on the other side, and a warning where there is no other side.
void partners_of_selection(const Context& ui, OverlayPainter& painter, const scene::Projector& project,
                           const scene::Mirror& mirror) {
  const scene::Document& document = ui.workspace.document;
  for (const auto v : scene::moving_vertices(document)) {
    const bool lacks = mirror.partners[v] == scene::Mirror::none;
    if (!lacks && !mirror.is_paired(v)) continue;
    if (const auto at = project(document.pose.positions[lacks ? v : mirror.partners[v]]))
      painter.circle(glm::vec2(*at), 7.5f, lacks ? ui.colors.bad : ui.colors.highlight, 1.25f);
  }
}

// Nothing where a corner is behind the camera.
void mirror_plane(const Context& ui, OverlayPainter& painter, const scene::Projector& project,
                  const scene::Mirror& mirror) {
  std::vector<glm::vec2> corners;
  for (const auto& corner : scene::rectangle_in_plane(mirror, ui.workspace.document.pose.positions)) {
    const auto at = project(corner);
    if (!at) return;
    corners.emplace_back(*at);
  }
  painter.tint(corners, faded(ui.colors.highlight, 0.07f));
  painter.outline(corners, faded(ui.colors.highlight, 0.35f));
}

void soft_circle(const Context& ui, OverlayPainter& painter) {
  const scene::Workspace& w = ui.workspace;
  const glm::dvec3 center = w.interaction.drag->grip().anchor.center + w.interaction.drag->transform().shift;
  const glm::dvec3 at(w.document.space.to_view({center.x, center.y, center.z}));
  if (!(w.camera.depth(glm::vec3(at)) > 0)) return;
  const scene::CursorProjection seen(at, w.camera, w.viewport);
  const auto pixels = static_cast<float>(w.handling.soft.radius * w.document.space.diagonal() *
                                         w.document.space.scale / seen.per_pixel());
  if (pixels < 4000) painter.circle(glm::vec2(seen.at()), pixels, ui.colors.highlight, 1.25f, 0.5f);
}

}  // namespace

void hand_overlay(const Context& ui) {
  const scene::Workspace& w = ui.workspace;
  if (!w.document.model.surface) return;
  OverlayPainter painter(ui);
  const scene::Projector project(w.document.space, w.camera, w.viewport);
  const scene::Mirror* const mirror = scene::mirror_of(w);
  const bool shows = w.view.cage && mirror && w.document.has_cage();
  if (shows && (w.interaction.show_partners || w.interaction.drag))
    mirror_plane(ui, painter, project, *mirror);
  if (shows && w.interaction.show_partners) {
    partner_map(ui, painter, project, *mirror);
  } else if (shows && !w.interaction.drag) {
    partners_of_selection(ui, painter, project, *mirror);
  }
  placed_pivot(ui, painter, project);
  if (w.interaction.drag && w.handling.soft.on && !w.interaction.drag->grip().vertices.empty())
    soft_circle(ui, painter);
}

}  // namespace viete::ui
