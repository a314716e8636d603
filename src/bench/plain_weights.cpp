#include "bench/plain_weights.h"

#include <algorithm>
#include <cmath>

namespace viete::bench {

using namespace deform;

namespace {

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a;
  const double t = dot(p - a, edge) / dot(edge, edge);
  if (t <= 0) return norm(p - a);
  if (t >= 1) return norm(p - b);
  return norm(p - a - t * edge);
}

// p = a + x (b - a) + y (c - a) + z n, by Cramer's rule.
double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a, w = p - a, normal = cross(u, v);
  const Vec3 n = (1 / norm(normal)) * normal;
  const double determinant = dot(u, cross(v, n));
  const double x = dot(w, cross(v, n)) / determinant, y = dot(u, cross(w, n)) / determinant;
  const double edges =
      std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
  const bool inside = x > 0 && y > 0 && x + y < 1;
  return inside ? std::min(edges, std::abs(dot(w, n))) : edges;
}

}  // namespace

void PlainWeights::compute(std::span<const mesh::Point> positions, const Cage& cage, double exponent) {
  const std::size_t k = cage.element_count();
  const auto& corners = cage.surface.positions;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (std::size_t j = 0; j < k; ++j) {
      const auto& t = cage.surface.triangles[j];
      distances_[i * k + j] = distance_to_triangle(positions[i], corners[t[0]], corners[t[1]], corners[t[2]]);
    }
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < k; ++j) {
      weights_[i * k + j] = std::pow(distances_[i * k + j], -exponent);
      sum += weights_[i * k + j];
    }
    for (std::size_t j = 0; j < k; ++j) weights_[i * k + j] /= sum;
  }
}

}  // namespace viete::bench
