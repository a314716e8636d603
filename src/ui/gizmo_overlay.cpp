#include <algorithm>
#include <vector>

#include "document/elements.h"
#include "interact/cursor_projection.h"
#include "interact/gizmo.h"
#include "interact/transform.h"
#include "interact/transform_drag.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "workspace/pointer.h"

namespace viete::ui {

namespace {

using interact::Constraint;
using Kind = Constraint::Kind;

// Draws the complete gizmo. During a drag, draws only the handle in use.
class GizmoDrawing {
public:
  GizmoDrawing(const Context& ui, OverlayPainter& painter, const interact::Gizmo& gizmo)
      : ui_(ui), painter_(painter), gizmo_(gizmo), interaction_(ui.workspace.view.interaction) {}

  void draw() {
    if (gizmo_.tool == interact::Tool::rotate) return rings();
    for (const int axis : gizmo_.far_to_near) plane(axis);
    for (const int axis : gizmo_.far_to_near) arm(axis);
    if (shown({})) center();
  }

private:
  bool shown(const Constraint& handle) const {
    return !interaction_.drag || interaction_.drag->constraint() == handle;
  }
  bool lit(const Constraint& handle) const {
    return interaction_.drag ? interaction_.drag->constraint() == handle : interaction_.handle == handle;
  }
  ImU32 color(const Constraint& handle) const {
    if (lit(handle)) return ui_.colors.highlight;
    return handle.kind == Kind::free ? ui_.colors.neutral : ui_.colors.axis[handle.axis];
  }

  void arm(int axis) {
    const Constraint handle{Kind::axis, axis};
    const auto& arm = gizmo_.arms[axis];
    if (!shown(handle) || arm.opacity <= 0) return;
    const ImU32 c = color(handle);
    painter_.line(arm.base, arm.tip, c, lit(handle) ? 3.0f : 2.25f, arm.opacity);
    if (gizmo_.tool == interact::Tool::scale) {
      painter_.polygon(square(0.5f * (arm.tip + arm.end), 5), c, arm.opacity);
    } else {
      arrow_head(arm, c);
    }
  }

  void arrow_head(const interact::Gizmo::Arm& arm, ImU32 c) {
    const glm::vec2 shaft = arm.tip - arm.base;
    const float length = glm::length(shaft);
    if (!(length > 0)) return;
    const glm::vec2 across = 5.0f / length * glm::vec2(-shaft.y, shaft.x);
    painter_.polygon(std::array{arm.tip + across, arm.end, arm.tip - across}, c, arm.opacity);
  }

  void plane(int axis) {
    const Constraint handle{Kind::plane, axis};
    const auto& plane = gizmo_.planes[axis];
    if (!shown(handle) || plane.opacity <= 0) return;
    painter_.tint(plane.corners, faded(color(handle), (lit(handle) ? 0.65f : 0.4f) * plane.opacity));
    painter_.outline(plane.corners, faded(color(handle), plane.opacity));
  }

  void center() {
    const ImU32 c = color({});
    const float width = lit({}) ? 2.25f : 1.5f;
    if (lit({})) painter_.tint(square(gizmo_.center, 5), faded(c, 0.25f));
    if (gizmo_.tool == interact::Tool::scale) {
      painter_.line(square(gizmo_.center, interact::gizmo_center - 1), c, width, true);
    } else {
      // Draws a diamond, because the hovered vertex already has a ring.
      painter_.line(diamond(gizmo_.center, interact::gizmo_center + 1), c, width, true);
    }
  }

  void rings() {
    for (int axis = 0; axis < 3; ++axis)
      if (shown({Kind::axis, axis})) ring_side(axis, false);
    if (shown({}))
      painter_.circle(gizmo_.center, interact::gizmo_view_ring, color({}), lit({}) ? 2.5f : 1.25f,
                      lit({}) ? 1 : 0.6f);
    for (const int axis : gizmo_.far_to_near)
      if (shown({Kind::axis, axis})) ring_side(axis, true);
  }

  // Draws the part of a ring that faces the camera, or the part that faces away.
  void ring_side(int axis, bool front) {
    const auto& ring = gizmo_.rings[axis];
    const std::size_t n = ring.size();
    std::size_t begin = 0;
    while (begin < n && !(ring[begin].front == front && ring[(begin + n - 1) % n].front != front)) ++begin;
    std::vector<glm::vec2> points;
    for (std::size_t i = 0; i < n && ring[(begin + i) % n].front == front; ++i)
      points.push_back(ring[(begin + i) % n].at);
    if (points.size() < 2) return;
    const bool bright = lit({Kind::axis, axis});
    const ImU32 c = color({Kind::axis, axis});
    if (front) return painter_.line(points, c, bright ? 3.0f : 2.25f, points.size() == n);
    painter_.line(points, c, 1.25f, false, 0.3f);
  }

  static std::array<glm::vec2, 4> diamond(const glm::vec2& center, float half) {
    return {center + glm::vec2(0, -half), center + glm::vec2(half, 0), center + glm::vec2(0, half),
            center + glm::vec2(-half, 0)};
  }

  const Context& ui_;
  OverlayPainter& painter_;
  const interact::Gizmo& gizmo_;
  const workspace::Interaction& interaction_;
};

void guides(const Context& ui, OverlayPainter& painter, const interact::DragGuides& guides) {
  constexpr float beyond_any_window = 6000;
  for (std::size_t i = 0; i < guides.axes.size(); ++i) {
    const glm::vec2 reach = beyond_any_window * guides.axis_directions[i];
    painter.line(guides.start - reach, guides.start + reach, ui.colors.axis[guides.axes[i]], 1, 0.55f);
  }
  if (guides.arc.empty()) return;
  const ImU32 c = ui.colors.highlight;
  for (int i = 0; i < std::min(guides.whole_turns, 3); ++i)
    painter.fan(guides.start, guides.circle, faded(c, 0.12f));
  painter.fan(guides.start, guides.arc, faded(c, 0.2f));
  painter.line(guides.start, guides.arc.front(), c, 1, 0.7f);
  painter.line(guides.start, guides.arc.back(), c, 1.5f);
}

// Shows the amount of the drag next to the cursor, inside the view.
void readout(const Context& ui, const std::string& text) {
  const auto& v = ui.workspace.view.camera.viewport;
  ImGui::PushFont(ui.fonts.numbers);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str()), cursor = ImGui::GetIO().MousePos;
  const float x = std::clamp(cursor.x + 22, v.origin.x + 12,
                             std::max(v.origin.x + 12, v.origin.x + v.size.x - size.x - 20));
  const float y = std::clamp(cursor.y + 22, v.origin.y + 8,
                             std::max(v.origin.y + 8, v.origin.y + v.size.y - size.y - 16));
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddRectFilled({x - 8, y - 5}, {x + size.x + 8, y + size.y + 5}, faded(ui.colors.card, 0.94f), 5);
  draw.AddRect({x - 8, y - 5}, {x + size.x + 8, y + size.y + 5}, ui.colors.line, 5);
  draw.AddText({x, y}, ui.colors.text, text.c_str());
  ImGui::PopFont();
}

}  // namespace

void gizmo_overlay(const Context& ui) {
  const auto& w = ui.workspace;
  const auto& drag = w.view.interaction.drag;
  if (w.view.interaction.box) return;
  OverlayPainter painter(ui);
  if (drag) guides(ui, painter, interact::drag_guides(*drag, w.document.space(), w.view.camera));
  if (const auto gizmo = workspace::gizmo_of(w)) GizmoDrawing(ui, painter, *gizmo).draw();
  if (drag) readout(ui, drag->readout());
}

namespace {

void cross(const Context& ui, OverlayPainter& painter, const glm::vec2& at, ImU32 color) {
  constexpr float inner = 4, outer = 11;
  for (const glm::vec2 direction : {glm::vec2(1, 0), glm::vec2(-1, 0), glm::vec2(0, 1), glm::vec2(0, -1)})
    painter.line(at + inner * direction, at + outer * direction, color, 1.5f);
  painter.circle(at, 7, color, 1.25f);
  painter.disc(at, 1.5f, ui.colors.text);
}

void placed_pivot(const Context& ui, OverlayPainter& painter, const interact::Projector& project) {
  const workspace::Workspace& w = ui.workspace;
  if (w.view.interaction.placing_pivot && w.view.interaction.cursor) {
    if (const auto at = project(workspace::pivot_place(w, *w.view.interaction.cursor)))
      cross(ui, painter, glm::vec2(*at), ui.colors.highlight);
    return;
  }
  if (w.view.handling.pivot != document::Pivot::point || !w.view.handling.point) return;
  if (const auto at = project(*w.view.handling.point)) cross(ui, painter, glm::vec2(*at), ui.colors.neutral);
}

// Draws rings at the mirror partners of the selection, and warning rings at selected unpaired vertices.
void partners_of_selection(const Context& ui, OverlayPainter& painter, const interact::Projector& project,
                           const document::Mirror& mirror) {
  const document::Document& document = ui.workspace.document;
  for (const auto v : document::moving_vertices(document)) {
    const bool lacks = mirror.partners[v] == document::Mirror::none;
    if (!lacks && !mirror.is_paired(v)) continue;
    if (const auto at = project(document.pose().positions[lacks ? v : mirror.partners[v]]))
      painter.circle(glm::vec2(*at), 7.5f, lacks ? ui.colors.bad : ui.colors.highlight, 1.25f);
  }
}

// Draws nothing if a corner is behind the camera.
void mirror_plane(const Context& ui, OverlayPainter& painter, const interact::Projector& project,
                  const document::Mirror& mirror) {
  std::vector<glm::vec2> corners;
  for (const auto& corner : document::rectangle_in_plane(mirror, ui.workspace.document.pose().positions)) {
    const auto at = project(corner);
    if (!at) return;
    corners.emplace_back(*at);
  }
  painter.tint(corners, faded(ui.colors.highlight, 0.07f));
  painter.outline(corners, faded(ui.colors.highlight, 0.35f));
}

void soft_circle(const Context& ui, OverlayPainter& painter) {
  const workspace::Workspace& w = ui.workspace;
  const interact::TransformDrag& drag = *w.view.interaction.drag;
  const glm::dvec3 center = drag.grip().anchor.center + drag.transform().shift;
  const glm::dvec3 at(w.document.space().to_view({center.x, center.y, center.z}));
  if (!(w.view.camera.depth(glm::vec3(at)) > 0)) return;
  const interact::CursorProjection seen(at, w.view.camera);
  const auto pixels = static_cast<float>(w.view.handling.soft.radius * w.document.space().diagonal() *
                                         w.document.space().scale / seen.per_pixel());
  if (pixels < 4000) painter.circle(glm::vec2(seen.at()), pixels, ui.colors.highlight, 1.25f, 0.5f);
}

}  // namespace

void hand_overlay(const Context& ui) {
  const workspace::Workspace& w = ui.workspace;
  if (!w.document.model().surface) return;
  OverlayPainter painter(ui);
  const interact::Projector project(w.document.space(), w.view.camera);
  const document::Mirror* const mirror = workspace::mirror_of(w);
  if (w.view.options.cage && mirror && w.document.has_cage()) {
    if (w.view.interaction.drag)
      mirror_plane(ui, painter, project, *mirror);
    else
      partners_of_selection(ui, painter, project, *mirror);
  }
  placed_pivot(ui, painter, project);
  if (w.view.interaction.drag && w.view.handling.soft.on && !w.view.interaction.drag->grip().vertices.empty())
    soft_circle(ui, painter);
}

}  // namespace viete::ui
