// Probes in the view: frames with three axes, and how far the selected ones reach.
#include <algorithm>

#include "scene/document/probes.h"
#include "scene/hand/cursor_projection.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"

namespace viete::ui {

namespace {

constexpr float axis_length = 22, dot = 5;  // logical pixels

struct Shown {
  bool selected, hovered, locked;
};

// As the probe has turned and stretched them, each of a length on screen that suits the eye.
void axes(const Context& ui, OverlayPainter& painter, const scene::CursorProjection& at,
          const glm::dvec3& center, const scene::ProbePose& pose, float opacity) {
  const auto& w = ui.workspace;
  const auto m = scene::linear_part(pose);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const glm::dvec3 column(m[axis], m[3 + axis], m[6 + axis]);
    const double length = glm::length(column);
    const glm::dvec3 along =
        double(axis_length) * at.per_pixel() * std::clamp(length, 0.4, 2.0) / length * column;
    const scene::CursorProjection end(center + along, w.camera, w.viewport);
    painter.line(glm::vec2(at.at()), glm::vec2(end.at()), ui.colors.axis[axis], 2.25f, opacity);
  }
}

// A ring about its vertex, filled where it holds; and a line to where it is wanted.
void pin(const Context& ui, OverlayPainter& painter, std::size_t i, glm::vec2 middle, const Shown& shown) {
  const auto& w = ui.workspace;
  const scene::Probe& probe = w.document.probes.all[i];
  const ImU32 color = shown.selected ? ui.colors.highlight : ui.colors.accent;
  const auto vertex = scene::pinned_vertex(w.document, i);
  const scene::CursorProjection at(glm::dvec3(w.document.space.to_view(vertex)), w.camera, w.viewport);
  painter.line(glm::vec2(at.at()), middle, color, 1.5f, 0.8f);
  if (!probe.pin->pulls) painter.disc(middle, dot - 1, color, 1);
  painter.circle(middle, dot + 2, color, 2);
  if (shown.hovered) painter.circle(middle, dot + 6, ui.colors.highlight, 1.5f);
}

void frame(const Context& ui, OverlayPainter& painter, std::size_t i, const Shown& shown) {
  const auto& w = ui.workspace;
  const scene::Probe& probe = w.document.probes.all[i];
  const glm::dvec3 center(w.document.space.to_view(scene::probe_center(w.document, i)));
  if (!(w.camera.depth(glm::vec3(center)) > 0)) return;
  const scene::CursorProjection at(center, w.camera, w.viewport);
  const glm::vec2 middle(at.at());
  const float opacity = shown.selected || shown.hovered ? 1.0f : 0.75f;
  if (probe.pin) return pin(ui, painter, i, middle, shown);
  if (shown.selected && !scene::shows_mask(w)) {
    const double radius = std::max({probe.turn.radius, probe.stretch.radius, probe.move.radius});
    const auto pixels = static_cast<float>(radius * w.document.space.scale / at.per_pixel());
    if (pixels < 4000) painter.circle(middle, pixels, ui.colors.highlight, 1.25f, 0.5f);
  }
  axes(ui, painter, at, center, probe.pose, opacity);
  const ImU32 color = shown.selected ? ui.colors.highlight : ui.colors.neutral;
  if (shown.locked) {
    painter.polygon(square(middle, dot), color, opacity);
  } else {
    painter.disc(middle, dot, color, opacity);
  }
  if (shown.hovered) painter.circle(middle, dot + 4, ui.colors.highlight, 1.5f);
}

}  // namespace

void probe_overlay(const Context& ui) {
  const auto& w = ui.workspace;
  if (!w.view.cage || w.document.probes.empty()) return;
  OverlayPainter painter(ui);
  const bool chosen = w.document.selection.kind() == scene::ElementKind::probe;
  for (std::size_t i = 0; i < w.document.probes.all.size(); ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    frame(ui, painter, i,
          {chosen && w.document.selection.contains(index), chosen && w.interaction.hovered == index,
           w.document.probes.all[i].locked});
  }
}

}  // namespace viete::ui
