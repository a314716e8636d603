#include "scene/sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/selection_sets.h"
#include "scene/workspace.h"

namespace viete::scene {

namespace {

constexpr float cell = 2;        // logical pixels
constexpr float behind = 0.01f;  // view units: the model's diagonal is 2

using Seen = std::vector<std::optional<glm::vec3>>;

void hide(Sight& sight, const Seen& points, std::span<const mesh::Triangle> triangles) {
  for (const auto& t : triangles) {
    if (points[t[0]] && points[t[1]] && points[t[2]])
      sight.hide_behind(*points[t[0]], *points[t[1]], *points[t[2]]);
  }
}

}  // namespace

Sight::Sight(const Camera& camera, const Viewport& viewport)
    : orthographic_(camera.pose().orthographic),
      columns_(std::max(1, static_cast<int>(std::ceil(viewport.window.x / cell)))),
      rows_(std::max(1, static_cast<int>(std::ceil(viewport.window.y / cell)))),
      nearest_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
               -std::numeric_limits<float>::infinity()) {}

float Sight::nearness(float depth) const {
  return orthographic_ ? -depth : 1 / depth;
}

// Every place of the raster whose middle is within.
void Sight::hide_behind(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec2 p = glm::vec2(a) / cell, u = glm::vec2(b) / cell - p, v = glm::vec2(c) / cell - p;
  const float area = u.x * v.y - u.y * v.x;
  if (area == 0 || !std::isfinite(area)) return;
  const glm::vec2 low = p + glm::min(glm::vec2(0), glm::min(u, v)),
                  high = p + glm::max(glm::vec2(0), glm::max(u, v));
  const auto within = [](float place, float end) { return static_cast<int>(std::clamp(place, -1.0f, end)); };
  const auto first = [&](float from, int count) {
    return std::max(0, within(std::ceil(from - 0.5f), static_cast<float>(count)));
  };
  const auto last = [&](float to, int count) {
    return within(std::floor(to - 0.5f), static_cast<float>(count - 1));
  };
  const float n = nearness(a.z), along_u = nearness(b.z) - n, along_v = nearness(c.z) - n;
  for (int y = first(low.y, rows_); y <= last(high.y, rows_); ++y) {
    float* row = nearest_.data() + static_cast<std::ptrdiff_t>(y) * columns_;
    for (int x = first(low.x, columns_); x <= last(high.x, columns_); ++x) {
      const glm::vec2 d = glm::vec2(x, y) + 0.5f - p;
      const float s = (d.x * v.y - d.y * v.x) / area, t = (u.x * d.y - u.y * d.x) / area;
      if (s >= 0 && t >= 0 && s + t <= 1) row[x] = std::max(row[x], n + s * along_u + t * along_v);
    }
  }
}

// Of the places around it the deepest one counts: what stands at an edge or on a steep face is seen.
bool Sight::sees(const glm::vec3& at) const {
  const glm::vec2 place = glm::floor(glm::vec2(at) / cell);
  if (!(std::abs(place.x) <= static_cast<float>(columns_) && std::abs(place.y) <= static_cast<float>(rows_)))
    return true;
  const int column = static_cast<int>(place.x), row = static_cast<int>(place.y);
  float deepest = std::numeric_limits<float>::infinity();
  for (int y = row - 1; y <= row + 1; ++y) {
    for (int x = column - 1; x <= column + 1; ++x) {
      if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return true;
      deepest = std::min(deepest, nearest_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                                           static_cast<std::size_t>(x)]);
    }
  }
  const float depth = at.z - behind;
  return (!orthographic_ && depth <= 0) || nearness(depth) >= deepest;
}

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
    // What is hidden hides nothing.
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

const Sight* SightKeeper::of(const Workspace& w) {
  if (!w.view.select_visible) return nullptr;
  const Picture now{w.camera.pose(),         {w.viewport.window, w.viewport.origin, w.viewport.size},
                    w.document.revisions,    w.posed.frame,
                    w.posed.vertices.data(), w.view.model,
                    w.document.groups.hidden};
  if (picture_ != now) {
    picture_ = now;
    sight_.emplace(sight_of(w));
  }
  return &*sight_;
}

}  // namespace viete::scene
