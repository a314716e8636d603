#include "document/brush.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "mesh/drawing.h"

namespace viete::document {

namespace {

float stepped(float share) {
  return std::round(std::clamp(share, 0.0f, 1.0f) * mask_steps) / mask_steps;
}

std::vector<float> shares_of(const Document& document) {
  if (document.mask()) return *document.mask();
  return std::vector<float>(document.model().surface->positions.size(), 1.0f);
}

weights::Mask mask_of(const std::vector<float>& shares) {
  const bool whole = std::ranges::all_of(shares, [](float s) { return s == 1; });
  return whole ? nullptr : std::make_shared<const std::vector<float>>(shares);
}

// Returns the strength of the brush at a distance from its center. The distance is relative to the radius.
float coverage(double distance) {
  const double t = std::clamp(2 * (1 - distance), 0.0, 1.0);
  return static_cast<float>(t * t * (3 - 2 * t));
}

}  // namespace

mesh::Point PosedModel::at(const mesh::Surface& model, std::size_t vertex) const {
  if (vertices.size() != model.positions.size()) return model.positions[vertex];
  const auto& p = vertices[vertex].position;
  return {origin[0] + p[0], origin[1] + p[1], origin[2] + p[2]};
}

namespace {

struct Hit {
  SurfacePoint point;
  double distance = std::numeric_limits<double>::infinity();
};

Hit first_triangle(const Document& document, const PosedModel& posed, const Ray& ray) {
  const mesh::Surface& model = *document.model().surface;
  const auto& [center, scale] = document.space();
  Hit nearest;
  for (std::uint32_t i = 0; i < model.triangles.size(); ++i) {
    std::array<glm::dvec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = scale * vector_of(posed.at(model, model.triangles[i][k]) - center);
    const auto hit = hit_triangle(ray, corners);
    if (hit && hit->distance > 0 && hit->distance < nearest.distance)
      nearest = {{model.triangles[i], hit->shares}, hit->distance};
  }
  return nearest;
}

// Prefers points near the ray to points that are a little nearer to its origin.
Hit first_point(const Document& document, const PosedModel& posed, const Ray& ray) {
  const OpenedSurface& model = document.model();
  const auto& [center, scale] = document.space();
  const double reach = scale * mesh::point_spacing(model.surface->positions);
  Hit nearest;
  double least = nearest.distance;
  for (std::uint32_t v = 0; v < model.surface->positions.size(); ++v) {
    if (model.splats && model.splats->is_faint(v)) continue;
    const glm::dvec3 offset = scale * vector_of(posed.at(*model.surface, v) - center) - ray.origin;
    const double along = glm::dot(offset, ray.direction);
    const double aside = glm::length(offset - along * ray.direction);
    if (!(along > 0 && aside <= reach && along + aside < least)) continue;
    least = along + aside;
    nearest = {{{v, v, v}, {1, 0, 0}}, along};
  }
  return nearest;
}

Hit first_hit(const Document& document, const PosedModel& posed, const Ray& ray) {
  const bool points = document.model().surface->triangles.empty();
  return points ? first_point(document, posed, ray) : first_triangle(document, posed, ray);
}

}  // namespace

std::optional<mesh::Point> pick_model(const Document& document, const PosedModel& posed, const Ray& ray) {
  const Hit hit = first_hit(document, posed, ray);
  if (!std::isfinite(hit.distance)) return std::nullopt;
  return document.space().to_file(ray.origin + hit.distance * ray.direction);
}

std::optional<SurfacePoint> pick_corners(const Document& document, const PosedModel& posed, const Ray& ray) {
  const Hit hit = first_hit(document, posed, ray);
  if (!std::isfinite(hit.distance)) return std::nullopt;
  return hit.point;
}

MaskStroke::MaskStroke(const Document& document)
    : before_(document.state()), shares_(shares_of(document)), covered_(shares_.size(), 0.0f) {}

void MaskStroke::dab(Document& document, const PosedModel& posed, const mesh::Point& center, double radius,
                     float share) {
  const mesh::Surface& model = *document.model().surface;
  bool painted = false;
  for (std::size_t v = 0; v < shares_.size(); ++v) {
    const mesh::Point p = posed.at(model, v);
    const double distance = std::hypot(p[0] - center[0], p[1] - center[1], p[2] - center[2]);
    const float cover = coverage(distance / radius);
    if (!(cover > covered_[v])) continue;
    covered_[v] = cover;
    const float old = before_.mask ? (*before_.mask)[v] : 1.0f;
    shares_[v] = stepped(std::lerp(old, share, cover));
    painted = true;
  }
  if (painted) document.put_mask(mask_of(shares_));
}

void MaskStroke::commit(Document& document) {
  if (same_mask(document.mask(), before_.mask)) return cancel(document);
  document.changed_history().record("paint", std::move(before_));
}

void MaskStroke::cancel(Document& document) const {
  document.put_mask(before_.mask);
}

bool same_mask(const weights::Mask& a, const weights::Mask& b) {
  return a == b || (a && b && *a == *b);
}

void set_mask(Document& document, weights::Mask mask, const char* label) {
  if (mask) mask = mask_of(*mask);
  if (same_mask(mask, document.mask())) return;
  record_edit(document, label);
  document.put_mask(std::move(mask));
}

weights::Mask inverted(const Document& document) {
  std::vector<float> shares = shares_of(document);
  for (float& s : shares) s = stepped(1 - s);
  return mask_of(shares);
}

}  // namespace viete::document
