#include "render/cavity.h"

#include <algorithm>
#include <cmath>

#include "render/upload.h"

namespace viete::render {

namespace {

/// Neighbours of every vertex: those of v are vertices[starts[v]] up to starts[v + 1]; an inner edge lists
/// each end twice.
struct Neighbours {
  std::vector<std::uint32_t> starts, vertices;
};

Neighbours neighbours(std::span<const Triangle> triangles, std::size_t vertex_count) {
  Neighbours result;
  result.starts.assign(vertex_count + 1, 0);
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) result.starts[v + 1] += 2;
  }
  for (std::size_t v = 0; v < vertex_count; ++v) result.starts[v + 1] += result.starts[v];
  result.vertices.resize(result.starts.back());
  std::vector<std::uint32_t> next(result.starts.begin(), result.starts.end() - 1);
  for (const Triangle& t : triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      result.vertices[next[t[corner]]++] = t[(corner + 1) % 3];
      result.vertices[next[t[corner]]++] = t[(corner + 2) % 3];
    }
  }
  return result;
}

template <class Value, class Get>
Value mean_around(const Neighbours& around, std::size_t v, Value zero, Get get) {
  Value sum = zero;
  for (std::uint32_t i = around.starts[v]; i < around.starts[v + 1]; ++i) sum += get(around.vertices[i]);
  const auto count = static_cast<float>(around.starts[v + 1] - around.starts[v]);
  return count > 0 ? sum / count : sum;
}

/// Mean sine of the angle by which the neighbours rise over the tangent plane: > 0 in a hollow.
float hollowness(const Neighbours& around, std::span<const glm::vec3> points, std::size_t v,
                 const glm::vec3& normal) {
  return mean_around(around, v, 0.0F, [&](std::uint32_t other) {
    const glm::vec3 edge = points[other] - points[v];
    const float length = glm::length(edge);
    return length > 0 ? glm::dot(edge, normal) / length : 0.0F;
  });
}

/// One step of averaging with the neighbours.
template <class Value>
void smooth(const Neighbours& around, std::vector<Value>& values, std::vector<Value>& scratch) {
  scratch = values;
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (around.starts[v] == around.starts[v + 1]) continue;
    const Value mean = mean_around(around, v, Value(0), [&](std::uint32_t other) { return scratch[other]; });
    values[v] = 0.5F * scratch[v] + 0.5F * mean;
  }
}

std::vector<glm::vec3> relative_points(std::span<const Point> positions) {
  std::vector<glm::vec3> points(positions.size());
  const Point origin = origin_of(positions);
  for (std::size_t v = 0; v < points.size(); ++v) points[v] = relative(positions[v], origin);
  return points;
}

}  // namespace

std::vector<float> bake_cavity(std::span<const Point> positions, std::span<const Point> normals,
                               std::span<const Triangle> triangles, int levels) {
  require_count("normals", normals.size(), positions.size());
  require_indices("triangles", triangles, positions.size());
  const Neighbours around = neighbours(triangles, positions.size());
  const std::vector<glm::vec3> points = relative_points(positions);

  std::vector<float> hollow(positions.size()), scratch;
  for (std::size_t v = 0; v < points.size(); ++v)
    hollow[v] = hollowness(around, points, v, relative(normals[v], {}));
  std::vector<float> sum(positions.size(), 0.0F);
  for (int level = 0; level < levels; ++level) {
    for (int step = 0; step < 1 << level; ++step) smooth(around, hollow, scratch);
    for (std::size_t v = 0; v < sum.size(); ++v) sum[v] += hollow[v];
  }
  for (float& value : sum) value = 1 - std::clamp(2.0F * value, 0.0F, 1.0F);
  return sum;
}

}  // namespace viete::render
