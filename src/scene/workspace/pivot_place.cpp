#include "scene/workspace/pivot_place.h"

#include <algorithm>

#include "scene/document/brush.h"
#include "scene/hand/cursor_projection.h"
#include "scene/hand/picking.h"

namespace viete::scene {

namespace {

// The point of an edge of the posed cage that is nearest to the ray under the cursor.
mesh::Point on_edge(const Workspace& w, std::uint32_t edge, const glm::vec2& cursor) {
  const auto& [i, j] = w.document.cage->edges[edge];
  const mesh::Point &a = w.document.pose.positions[i], &b = w.document.pose.positions[j];
  const Ray ray = w.camera.ray(cursor, w.viewport);
  const glm::dvec3 way = w.document.space.scale * vector_of(b - a);
  const glm::dvec3 normal = glm::cross(ray.direction, glm::cross(ray.direction, way));
  const double slope = glm::dot(way, normal);
  const glm::dvec3 from = ray.origin - glm::dvec3(w.document.space.to_view(a));
  return a + (slope != 0 ? std::clamp(glm::dot(from, normal) / slope, 0.0, 1.0) : 0) * (b - a);
}

mesh::Point beside_target(const Workspace& w, const glm::vec2& cursor) {
  const glm::dvec3 target(w.camera.pose().target);
  const CursorProjection projection(target, w.camera, w.viewport);
  const auto at = projection.in_plane(-glm::dvec3(w.camera.forward()), w.camera.ray(cursor, w.viewport));
  return w.document.space.to_file(at.value_or(target));
}

}  // namespace

mesh::Point pivot_place(const Workspace& w, const glm::vec2& cursor) {
  if (w.document.has_cage() && w.view.cage) {
    const auto under = [&](ElementKind kind) {
      return pick_element(w.document, kind, w.camera, w.viewport, cursor);
    };
    if (const auto vertex = under(ElementKind::vertex)) return w.document.pose.positions[vertex->index];
    if (const auto edge = under(ElementKind::edge)) return on_edge(w, edge->index, cursor);
  }
  if (const auto on_model = pick_model(w.document, w.posed, w.camera.ray(cursor, w.viewport)))
    return *on_model;
  return beside_target(w, cursor);
}

}  // namespace viete::scene
