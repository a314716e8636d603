#include "interact/picking.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "document/elements.h"

namespace viete::interact {

namespace {

constexpr float cell = 2;        // the size of a sample, in logical pixels
constexpr float behind = 0.01f;  // points up to this far behind a surface are visible, in view units

}  // namespace

Sight::Sight(const document::Camera& camera)
    : orthographic_(camera.pose().orthographic),
      columns_(std::max(1, static_cast<int>(std::ceil(camera.viewport.window.x / cell)))),
      rows_(std::max(1, static_cast<int>(std::ceil(camera.viewport.window.y / cell)))),
      nearest_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
               -std::numeric_limits<float>::infinity()) {}

float Sight::nearness(float depth) const {
  return orthographic_ ? -depth : 1 / depth;
}

// Updates each sample whose center is inside the triangle, if the triangle is the nearest surface there.
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

// Compares with the farthest of 3 x 3 samples around the point. Therefore, points on steep faces are visible.
bool Sight::sees(const glm::vec3& at) const {
  const glm::vec2 place = glm::floor(glm::vec2(at) / cell);
  if (!(std::abs(place.x) <= static_cast<float>(columns_) && std::abs(place.y) <= static_cast<float>(rows_)))
    return true;
  const int column = static_cast<int>(place.x), row = static_cast<int>(place.y);
  float deepest = std::numeric_limits<float>::infinity();
  for (int y = row - 1; y <= row + 1; ++y)
    for (int x = column - 1; x <= column + 1; ++x) {
      if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return true;
      deepest = std::min(deepest, nearest_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                                           static_cast<std::size_t>(x)]);
    }
  const float depth = at.z - behind;
  return (!orthographic_ && depth <= 0) || nearness(depth) >= deepest;
}

namespace {

constexpr float tolerance = 8;  // in logical pixels

using Flags = std::vector<std::uint8_t>;

// Chooses one of the candidates near the cursor, as pick_element() describes.
class Nearest {
public:
  Nearest(const Sight* sight, const Flags& hidden) : sight_(sight), hidden_(hidden) {}

  void offer(std::uint32_t index, float distance, const glm::vec3& at) {
    if (!(distance <= tolerance) || hidden_[index] || (sight_ && !sight_->sees(at))) return;
    nearest_ = std::min(nearest_, distance);
    close_.push_back({{index, at.z}, distance});
  }

  std::optional<Pick> best() const {
    constexpr float tie = 2;
    std::optional<Pick> best;
    for (const auto& [pick, distance] : close_) {
      if (distance <= nearest_ + tie && (!best || pick.depth < best->depth)) best = pick;
    }
    return best;
  }

private:
  const Sight* sight_;
  const Flags& hidden_;
  float nearest_ = std::numeric_limits<float>::max();
  std::vector<std::pair<Pick, float>> close_;
};

std::optional<Pick> pick_point(const Projector& project, std::span<const mesh::Point> points,
                               const glm::vec2& cursor, const Sight* sight, const Flags& hidden) {
  Nearest nearest(sight, hidden);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (const auto at = project(points[i])) nearest.offer(i, glm::distance(glm::vec2(*at), cursor), *at);
  }
  return nearest.best();
}

// Interpolates an edge's depth linearly on screen. In perspective, this depth is only approximate.
std::optional<Pick> pick_edge(const Projector& project, std::span<const mesh::Point> points,
                              std::span<const mesh::Edge> edges, const glm::vec2& cursor, const Sight* sight,
                              const Flags& hidden) {
  Nearest nearest(sight, hidden);
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const auto ends = project.segment(points[edges[i][0]], points[edges[i][1]]);
    if (!ends) continue;
    const glm::vec2 a((*ends)[0]), along = glm::vec2((*ends)[1]) - a;
    const float square = glm::dot(along, along);
    const float t = square > 0 ? std::clamp(glm::dot(cursor - a, along) / square, 0.0f, 1.0f) : 0.0f;
    nearest.offer(i, glm::distance(a + t * along, cursor), glm::mix((*ends)[0], (*ends)[1], t));
  }
  return nearest.best();
}

std::optional<Pick> pick_inside(const document::Document& document, const document::Camera& camera,
                                const document::Ray& ray, const Flags& hidden) {
  const mesh::Surface& cage = document.cage()->surface;
  // In an orthographic view, points behind the eye are visible.
  const double start = camera.pose().orthographic ? -std::numeric_limits<double>::max() : 0;
  double first = std::numeric_limits<double>::max();
  std::optional<Pick> best;
  for (std::size_t t = 0; t < cage.triangles.size(); ++t) {
    if (hidden[cage.triangle_polygon[t]]) continue;
    std::array<glm::dvec3, 3> corners;
    for (int i = 0; i < 3; ++i)
      corners[i] = document.space().to_view(document.pose().positions[cage.triangles[t][i]]);
    const auto hit = hit_triangle(ray, corners);
    if (!hit || hit->distance <= start || hit->distance >= first) continue;
    first = hit->distance;
    best = Pick{cage.triangle_polygon[t], camera.depth(glm::vec3(ray.origin + first * ray.direction))};
  }
  return best;
}

std::optional<std::uint32_t> face_at(const pose::Cage& cage, const mesh::Edge& edge, const Flags& hidden) {
  for (std::uint32_t f = 0; f < cage.surface.polygon_count(); ++f) {
    const auto vertices = element_vertices(cage, document::ElementKind::face, f);
    const auto has = [&](std::uint32_t v) { return std::ranges::count(vertices, v) > 0; };
    if (!hidden[f] && has(edge[0]) && has(edge[1])) return f;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Pick> pick_element(const document::Document& document, document::ElementKind kind,
                                 const document::Camera& camera, const glm::vec2& cursor,
                                 const Sight* sight) {
  const Projector project(document.space(), camera);
  const Flags hidden = hidden_elements(document, kind);
  if (kind == document::ElementKind::probe)
    return pick_point(project, probe_centers(document), cursor, nullptr, hidden);
  if (!document.has_cage()) return std::nullopt;
  const auto& points = document.pose().positions;
  const auto& edges = document.cage()->edges;
  if (kind == document::ElementKind::vertex) return pick_point(project, points, cursor, sight, hidden);
  if (kind == document::ElementKind::edge) return pick_edge(project, points, edges, cursor, sight, hidden);
  const auto inside = pick_inside(document, camera, camera.ray(cursor), hidden);
  if (inside && (!sight || sight->sees({cursor, inside->depth}))) return inside;
  const Flags hidden_edges = hidden_elements(document, document::ElementKind::edge);
  const auto edge = pick_edge(project, points, edges, cursor, sight, hidden_edges);
  if (!edge) return std::nullopt;
  const auto face = face_at(*document.cage(), edges[edge->index], hidden);
  return face ? std::optional(Pick{*face, edge->depth}) : std::nullopt;
}

std::optional<Pick> pick_element(const document::Document& document, const document::Camera& camera,
                                 const glm::vec2& cursor, const Sight* sight) {
  return pick_element(document, document.selection().kind(), camera, cursor, sight);
}

bool is_crowded(const document::Document& document, const document::Camera& camera, const glm::vec2& cursor,
                const Sight* sight) {
  constexpr int crowd = 8;
  if (!document.has_cage() || document.selection().kind() == document::ElementKind::probe) return false;
  const Projector project(document.space(), camera);
  const Flags hidden = hidden_elements(document, document::ElementKind::vertex);
  int close = 0;
  for (std::size_t v = 0; v < hidden.size(); ++v) {
    const auto at = project(document.pose().positions[v]);
    if (!at || hidden[v] || glm::distance(glm::vec2(*at), cursor) > 4 * tolerance) continue;
    if (!sight || sight->sees(*at)) ++close;
    if (close == crowd) return true;
  }
  return false;
}

namespace {

template <class Inside>
std::vector<std::uint32_t> pick_within(const document::Document& document, const document::Camera& camera,
                                       const Inside& inside, const Sight* sight) {
  const Projector project(document.space(), camera);
  const auto kind = document.selection().kind();
  const auto points =
      kind == document::ElementKind::probe ? probe_centers(document) : document.pose().positions;
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const auto at = project(points[i]);
    if (at && inside(glm::vec2(*at))) found.push_back(i);
  }
  if (kind == document::ElementKind::probe || !document.has_cage()) return found;
  const document::Selection vertices(document::ElementKind::vertex, found);
  found = without_hidden(document, converted(*document.cage(), vertices, kind)).indices();
  if (sight) {
    std::erase_if(found, [&](auto i) {
      const auto at = project(element_middle(document, kind, i));
      return !at || !sight->sees(*at);
    });
  }
  return found;
}

}  // namespace

std::vector<std::uint32_t> pick_elements_in_box(const document::Document& document,
                                                const document::Camera& camera, const glm::vec2& corner,
                                                const glm::vec2& opposite, const Sight* sight) {
  const glm::vec2 low = glm::min(corner, opposite), high = glm::max(corner, opposite);
  const auto inside = [&](const glm::vec2& p) {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y;
  };
  return pick_within(document, camera, inside, sight);
}

std::vector<std::uint32_t> pick_elements_in_lasso(const document::Document& document,
                                                  const document::Camera& camera,
                                                  std::span<const glm::vec2> line, const Sight* sight) {
  return pick_within(
      document, camera, [&](const glm::vec2& p) { return encloses(line, p); }, sight);
}

std::vector<std::uint32_t> pick_elements_in_circle(const document::Document& document,
                                                   const document::Camera& camera, const glm::vec2& center,
                                                   float radius, const Sight* sight) {
  const Projector project(document.space(), camera);
  const auto kind = document.selection().kind();
  const auto under = pick_element(document, camera, center, sight);
  const Flags hidden = hidden_elements(document, kind);
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < hidden.size(); ++i) {
    if (hidden[i]) continue;
    const auto at = project(element_middle(document, kind, i));
    const bool within = at && glm::distance(glm::vec2(*at), center) <= radius &&
                        (!sight || kind == document::ElementKind::probe || sight->sees(*at));
    if (within || (under && under->index == i)) found.push_back(i);
  }
  return found;
}

void draw_on(Lasso& lasso, const glm::vec2& to) {
  constexpr float step = 2;
  if (lasso.line.empty() || glm::distance(lasso.line.back(), to) >= step) lasso.line.push_back(to);
}

// Computes the winding number: the signed count of the sides that cross a ray to the right.
bool encloses(std::span<const glm::vec2> line, const glm::vec2& point) {
  int turns = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const glm::vec2 a = line[i], b = line[(i + 1) % line.size()];
    if ((a.y <= point.y) == (b.y <= point.y)) continue;
    const float x = a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x);
    if (x > point.x) turns += b.y > a.y ? 1 : -1;
  }
  return turns != 0;
}

}  // namespace viete::interact
