#include "scene/hand/shaping.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/document/camera.h"
#include "scene/document/elements.h"
#include "scene/document/space.h"
#include "scene/hand/cursor_projection.h"

namespace viete::scene {

namespace {

// The mean of the farthest fifth of the moving vertices.
glm::dvec3 far_end(const Document& document, const Grip& grip, const glm::dvec3& from) {
  std::vector<std::pair<double, glm::dvec3>> places;
  for (const Gripped& g : grip.vertices) {
    const glm::dvec3 p = vector_of(document.pose.positions[g.vertex]);
    if (g.side != Gripped::Side::other && g.share == 1) places.emplace_back(-glm::distance(p, from), p);
  }
  std::ranges::sort(places, {}, [](const auto& place) { return place.first; });
  const std::size_t count = std::max<std::size_t>(1, places.size() / 5);
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < std::min(count, places.size()); ++i) sum += places[i].second;
  return places.empty() ? from : sum / static_cast<double>(count);
}

std::optional<glm::dvec3> active_center(const Document& document) {
  const auto active = document.selection.active();
  if (!active) return std::nullopt;
  glm::dvec3 sum(0);
  const auto own = element_vertices(*document.cage, document.selection.kind(), *active);
  for (const auto v : own) sum += vector_of(document.pose.positions[v]) / static_cast<double>(own.size());
  return sum;
}

void put_ends(const Document& document, const Grip& grip, bool at_median, const Camera& camera,
              Shaping& shaping) {
  shaping.from = grip.anchor.center;
  if (at_median) {
    const auto vertices = leading_vertices(document, nullptr);
    shaping.from = joint_of(document, vertices).value_or(far_end(document, grip, grip.anchor.center));
  }
  const double size = document.space.diagonal();
  shaping.to = active_center(document).value_or(shaping.from);
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

// Displacements to the mean of the neighbours.
std::vector<mesh::Vec3> smoothing_ways(const Document& document, const Grip& grip) {
  const auto& positions = document.pose.positions;
  std::vector<mesh::Point> sums(positions.size(), {0, 0, 0});
  std::vector<double> counts(positions.size(), 0);
  for (const auto& [a, b] : document.cage->edges) {
    sums[a] = sums[a] + positions[b], sums[b] = sums[b] + positions[a];
    ++counts[a], ++counts[b];
  }
  std::vector<mesh::Vec3> ways;
  for (const Gripped& g : grip.vertices) {
    const auto v = g.vertex;
    ways.push_back(counts[v] > 0 ? 1 / counts[v] * sums[v] - positions[v] : mesh::Vec3{0, 0, 0});
  }
  return ways;
}

std::vector<mesh::Vec3> relaxing_ways(const Document& document, const Grip& grip) {
  std::vector<mesh::Vec3> ways;
  for (const Gripped& g : grip.vertices)
    ways.push_back(document.cage->surface.positions[g.vertex] - document.pose.positions[g.vertex]);
  return ways;
}

// Vertex normals, area-weighted.
std::vector<mesh::Vec3> pushing_ways(const Document& document, const Grip& grip) {
  const auto& positions = document.pose.positions;
  std::vector<mesh::Vec3> normals(positions.size(), {0, 0, 0});
  for (const auto& t : document.cage->surface.triangles) {
    const mesh::Vec3 n = mesh::cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
    for (const auto v : t) normals[v] = normals[v] + n;
  }
  std::vector<mesh::Vec3> ways;
  for (const Gripped& g : grip.vertices) {
    const double length = mesh::stable_norm(normals[g.vertex]);
    ways.push_back(length > 0 ? 1 / length * normals[g.vertex] : mesh::Vec3{0, 0, 0});
  }
  return ways;
}

// Displacements to the best fitting plane of the leading vertices; the other side uses its mirror image.
std::vector<mesh::Vec3> flattening_ways(const Document& document, const Grip& grip) {
  std::vector<mesh::Point> leading;
  for (const Gripped& g : grip.vertices) {
    if (g.share == 1 && g.side != Gripped::Side::other) leading.push_back(document.pose.positions[g.vertex]);
  }
  const auto axes = axes_of_points(leading);
  if (!axes) return std::vector<mesh::Vec3>(grip.vertices.size(), mesh::Vec3{0, 0, 0});
  const glm::dvec3 n = (*axes)[2];
  glm::dvec3 middle(0);
  for (const auto& p : leading) middle += vector_of(p) / static_cast<double>(leading.size());
  std::vector<mesh::Vec3> ways;
  for (const Gripped& g : grip.vertices) {
    const bool other = g.side == Gripped::Side::other;
    const mesh::Point& p = document.pose.positions[g.vertex];
    const glm::dvec3 from = vector_of(other ? reflected(grip.plane, p) : p);
    const mesh::Vec3 way = point_of(-glm::dot(from - middle, n) * n);
    ways.push_back(other ? reflected_direction(grip.plane, way) : way);
  }
  return ways;
}

}  // namespace

Shaping shaping_of(const Document& document, Shape shape, const Grip& grip, bool at_median,
                   const Camera& camera) {
  Shaping shaping;
  shaping.shape = shape;
  switch (shape) {
    case Shape::none: break;
    case Shape::bend:
    case Shape::twist:
    case Shape::taper: put_ends(document, grip, at_median, camera, shaping); break;
    case Shape::push: shaping.ways = pushing_ways(document, grip); break;
    case Shape::smooth: shaping.ways = smoothing_ways(document, grip); break;
    case Shape::relax: shaping.ways = relaxing_ways(document, grip); break;
    case Shape::flatten: shaping.ways = flattening_ways(document, grip); break;
  }
  return shaping;
}

std::optional<glm::dvec3> hinge_near(const Shaping& shaping, const glm::dvec3& direction) {
  const glm::dvec3 a = glm::normalize(shaping.to - shaping.from);
  const glm::dvec3 across = direction - glm::dot(direction, a) * a;
  if (!(glm::length(across) > 1e-3)) return std::nullopt;
  return glm::normalize(across);
}

}  // namespace viete::scene
