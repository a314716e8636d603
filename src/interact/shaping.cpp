#include "interact/shaping.h"

#include <algorithm>

#include "document/camera.h"
#include "document/space.h"
#include "interact/cursor_projection.h"

namespace viete::interact {

namespace {

// Sorts the vertices with share 1 by distance from `from`. Returns the mean position of the farthest 20 %.
glm::dvec3 far_end(const document::Document& document, const Grip& grip, const glm::dvec3& from) {
  std::vector<std::pair<double, glm::dvec3>> places;
  for (const Gripped& g : grip.vertices) {
    const glm::dvec3 p = document::vector_of(document.pose().positions[g.vertex]);
    if (g.side != Gripped::Side::other && g.share == 1) places.emplace_back(-glm::distance(p, from), p);
  }
  std::ranges::sort(places, {}, [](const auto& place) { return place.first; });
  const std::size_t count = std::max<std::size_t>(1, places.size() / 5);
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < std::min(count, places.size()); ++i) sum += places[i].second;
  return places.empty() ? from : sum / static_cast<double>(count);
}

void put_ends(const document::Document& document, const Grip& grip, bool at_median,
              const document::Camera& camera, Shaping& shaping) {
  shaping.from = grip.anchor.center;
  if (at_median) {
    const auto vertices = leading_vertices(document, nullptr);
    shaping.from = joint_of(document, vertices).value_or(far_end(document, grip, grip.anchor.center));
  }
  const double size = document.space().diagonal();
  shaping.to = center_of_active(document).value_or(shaping.from);
  if (glm::distance(shaping.from, shaping.to) < 1e-6 * size)
    shaping.to = far_end(document, grip, shaping.from);
  const glm::dvec3 way = shaping.to - shaping.from;
  if (glm::length(way) < 1e-6 * size) {
    shaping.shape = Shape::none;
    return;
  }
  const auto hinge = hinge_near(shaping, -glm::dvec3(camera.forward()));
  shaping.hinge = hinge.value_or(plane_axes(glm::normalize(way)).u);
}

std::vector<mesh::Vec3> smoothing_displacements(const document::Document& document, const Grip& grip) {
  const auto& positions = document.pose().positions;
  std::vector<mesh::Point> sums(positions.size(), {0, 0, 0});
  std::vector<double> counts(positions.size(), 0);
  for (const auto& [a, b] : document.cage()->edges) {
    sums[a] = sums[a] + positions[b];
    sums[b] = sums[b] + positions[a];
    ++counts[a];
    ++counts[b];
  }
  std::vector<mesh::Vec3> displacements;
  for (const Gripped& g : grip.vertices) {
    const auto v = g.vertex;
    displacements.push_back(counts[v] > 0 ? 1 / counts[v] * sums[v] - positions[v] : mesh::Vec3{0, 0, 0});
  }
  return displacements;
}

std::vector<mesh::Vec3> relaxing_displacements(const document::Document& document, const Grip& grip) {
  std::vector<mesh::Vec3> displacements;
  for (const Gripped& g : grip.vertices)
    displacements.push_back(document.cage()->surface.positions[g.vertex] -
                            document.pose().positions[g.vertex]);
  return displacements;
}

}  // namespace

Shaping shaping_of(const document::Document& document, Shape shape, const Grip& grip, bool at_median,
                   const document::Camera& camera) {
  Shaping shaping;
  shaping.shape = shape;
  switch (shape) {
    case Shape::none: break;
    case Shape::bend:
    case Shape::twist:
    case Shape::taper: put_ends(document, grip, at_median, camera, shaping); break;
    case Shape::smooth: shaping.displacements = smoothing_displacements(document, grip); break;
    case Shape::relax: shaping.displacements = relaxing_displacements(document, grip); break;
  }
  return shaping;
}

std::optional<glm::dvec3> hinge_near(const Shaping& shaping, const glm::dvec3& direction) {
  const glm::dvec3 a = glm::normalize(shaping.to - shaping.from);
  const glm::dvec3 across = direction - glm::dot(direction, a) * a;
  if (!(glm::length(across) > 1e-3)) return std::nullopt;
  return glm::normalize(across);
}

}  // namespace viete::interact
