// The vertex whose sum is shown: lines to the elements that it takes from, and what their maps do, as
// ellipsoids.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/hand/cursor_projection.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"

namespace viete::ui {

namespace {

constexpr std::size_t most_elements = 16;
constexpr double size = 0.025;  // of an undeformed ball, in diagonals

// Three rings of a ball, one across each axis, as the map has made them.
void ellipsoid(OverlayPainter& painter, const Context& ui, const scene::Projector& project,
               const scene::VertexView::Term& term, double radius, float opacity) {
  constexpr int steps = 32;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<glm::vec2> ring;
    for (int i = 0; i < steps; ++i) {
      const double angle = 2 * std::numbers::pi * i / steps;
      glm::dvec3 p(0);
      p[(axis + 1) % 3] = radius * std::cos(angle), p[(axis + 2) % 3] = radius * std::sin(angle);
      const glm::dvec3 d = term.map * p;
      const auto at = project(term.at + decltype(term.at){d.x, d.y, d.z});
      if (!at) return;
      ring.emplace_back(*at);
    }
    painter.line(ring, ui.colors.axis[axis], 1.25f, true, opacity);
  }
}

}  // namespace

void vertex_overlay(const Context& ui) {
  const scene::Workspace& w = ui.workspace;
  const scene::VertexView& view = w.vertex;
  if (!view.vertex || !w.document.model.surface) return;
  const scene::Projector project(w.document.space, w.camera, w.viewport);
  const auto at = project(w.posed.at(*w.document.model.surface, *view.vertex));
  if (!at) return;
  OverlayPainter painter(ui);
  const double radius = size * w.document.space.diagonal();
  const double largest = view.terms.empty() ? 1 : std::abs(view.terms.front().weight);
  for (std::size_t i = 0; i < std::min(most_elements, view.terms.size()); ++i) {
    const auto& term = view.terms[i];
    const auto share = static_cast<float>(std::abs(term.weight) / largest);
    const auto end = project(term.at);
    if (!end || share < 0.02f) continue;
    painter.line(glm::vec2(*at), glm::vec2(*end), term.weight < 0 ? ui.colors.warn : ui.colors.accent,
                 0.75f + 3 * share, 0.35f + 0.5f * share);
    if (view.has_logs) ellipsoid(painter, ui, project, term, radius, 0.4f + 0.6f * share);
  }
  if (view.has_logs) {
    const scene::VertexView::Term whole{
        0, 1, view.map, w.posed.at(*w.document.model.surface, *view.vertex), {}};
    ellipsoid(painter, ui, project, whole, 1.5 * radius, 1);
  }
  painter.disc(glm::vec2(*at), 4, ui.colors.highlight, 1);
}

}  // namespace viete::ui
