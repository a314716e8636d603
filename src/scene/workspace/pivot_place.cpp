#include "scene/workspace/pivot_place.h"

#include "scene/document/brush.h"
#include "scene/hand/cursor_projection.h"
#include "scene/hand/picking.h"

namespace viete::scene {

namespace {

constexpr float near_vertex = 8, near_edge = 6;  // logical pixels

std::optional<mesh::Point> vertex_under(const Projector& project, const Document& document,
                                        const glm::vec2& cursor) {
  float nearest = near_vertex;
  std::optional<mesh::Point> found;
  for (const mesh::Point& p : document.pose.positions) {
    const auto at = project(p);
    const float away = at ? glm::distance(glm::vec2(*at), cursor) : near_vertex + 1;
    if (away <= nearest) nearest = away, found = p;
  }
  return found;
}

// Converts a fraction t along a projected segment to one along the segment in space.
double share_in_space(double t, double depth_a, double depth_b, bool orthographic) {
  return orthographic ? t : t * depth_a / ((1 - t) * depth_b + t * depth_a);
}

std::optional<mesh::Point> edge_under(const Projector& project, const Workspace& w, const glm::vec2& cursor) {
  const auto& points = w.document.pose.positions;
  float nearest = near_edge;
  std::optional<mesh::Point> found;
  for (const auto& [a, b] : w.document.cage->edges) {
    const auto from = project(points[a]), to = project(points[b]);
    if (!from || !to) continue;
    const glm::vec2 way = glm::vec2(*to) - glm::vec2(*from);
    const float square = glm::dot(way, way);
    const float t =
        square > 0 ? glm::clamp(glm::dot(cursor - glm::vec2(*from), way) / square, 0.0f, 1.0f) : 0.0f;
    const float away = glm::distance(cursor, glm::vec2(*from) + t * way);
    if (away > nearest) continue;
    nearest = away;
    const double s = share_in_space(t, from->z, to->z, w.camera.pose().orthographic);
    found = points[a] + s * (points[b] - points[a]);
  }
  return found;
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
    const Projector project(w.document.space, w.camera, w.viewport);
    if (const auto vertex = vertex_under(project, w.document, cursor)) return *vertex;
    if (const auto edge = edge_under(project, w, cursor)) return *edge;
  }
  if (const auto on_model = pick_model(w.document, w.posed, w.camera.ray(cursor, w.viewport)))
    return *on_model;
  return beside_target(w, cursor);
}

}  // namespace viete::scene
