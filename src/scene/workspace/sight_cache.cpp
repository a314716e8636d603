#include "scene/workspace/sight_cache.h"

#include <span>

#include "scene/document/selection_sets.h"
#include "scene/hand/cursor_projection.h"

namespace viete::scene {

namespace {

using Seen = std::vector<std::optional<glm::vec3>>;

void hide(Sight& sight, const Seen& points, std::span<const mesh::Triangle> triangles) {
  for (const auto& t : triangles) {
    if (points[t[0]] && points[t[1]] && points[t[2]])
      sight.hide_behind(*points[t[0]], *points[t[1]], *points[t[2]]);
  }
}

}  // namespace

Sight sight_of(const Workspace& w) {
  Sight sight(w.camera, w.viewport);
  const Projector project(w.document.space, w.camera, w.viewport);
  Seen points;
  if (w.view.model && w.document.model.surface) {
    const mesh::Surface& model = *w.document.model.surface;
    points.reserve(model.positions.size());
    for (std::size_t v = 0; v < model.positions.size(); ++v) points.push_back(project(w.posed.at(model, v)));
    hide(sight, points, model.triangles);
  }
  if (w.document.has_cage()) {
    points.clear();
    for (const auto& p : w.document.pose.positions) points.push_back(project(p));
    // Hidden faces do not occlude.
    const auto hidden = hidden_elements(w.document, ElementKind::face);
    const mesh::Surface& cage = w.document.cage->surface;
    std::vector<mesh::Triangle> triangles;
    for (std::size_t t = 0; t < cage.triangles.size(); ++t) {
      if (!hidden[cage.triangle_polygon[t]]) triangles.push_back(cage.triangles[t]);
    }
    hide(sight, points, triangles);
  }
  return sight;
}

const Sight* SightCache::of(const Workspace& w) {
  if (!w.view.select_visible) return nullptr;
  const Picture now{w.camera.pose(),         w.viewport,   w.document.revisions(),  w.posed.frame,
                    w.posed.vertices.data(), w.view.model, w.document.groups.hidden};
  if (picture_ != now) {
    picture_ = now;
    sight_.emplace(sight_of(w));
  }
  return &*sight_;
}

}  // namespace viete::scene
