#include "scene/hand/sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viete::scene {

namespace {

constexpr float cell = 2;        // logical pixels
constexpr float behind = 0.01f;  // view units: the model's diagonal is 2

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

}  // namespace viete::scene
