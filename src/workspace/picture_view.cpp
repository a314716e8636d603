#include "workspace/picture_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viete::workspace {

namespace {

using mesh::Point, mesh::Vec3;

using Corners = std::span<const std::uint32_t>;

constexpr Vec3 to_light{-0.42, 0.68, 0.6};  // unit vector
constexpr double shade = 0.62, span_of_light = 0.38;

sym3::Mat3<double> turn_of(const PictureAngles& angles) {
  const double yaw = angles.yaw * std::numbers::pi / 180, pitch = angles.pitch * std::numbers::pi / 180;
  const double c = std::cos(yaw), s = std::sin(yaw), d = std::cos(pitch), t = std::sin(pitch);
  return {c, 0, s, t * s, d, -t * c, -d * s, t, d * c};
}

Corners corners_of(const mesh::Surface& surface, std::size_t polygon) {
  const auto first = surface.polygon_starts[polygon], end = surface.polygon_starts[polygon + 1];
  return Corners(surface.corners).subspan(first, end - first);
}

// The normal of a polygon in the view. The length is twice the area.
Vec3 normal_of(const PictureView& view, Corners corners, std::span<const Point> at) {
  Vec3 sum{0, 0, 0};
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Vec3 first = view.seen(at[corners[0]]);
    const Vec3 n = mesh::cross(view.seen(at[corners[i - 1]]) - first, view.seen(at[corners[i]]) - first);
    for (int k = 0; k < 3; ++k) sum[k] += n[k];
  }
  return sum;
}

double nearness(const PictureView& view, Corners corners, std::span<const Point> at) {
  double sum = 0;
  for (const auto v : corners) sum += view.seen(at[v])[2];
  return sum / static_cast<double>(corners.size());
}

}  // namespace

float lightness(const Vec3& normal) {
  const double lit = mesh::dot(normal, to_light) / mesh::norm(normal);
  return static_cast<float>(shade + span_of_light * std::clamp(lit, -0.6, 1.0));
}

PictureView::PictureView(const PictureAngles& angles, const Frame& frame)
    : turn_(turn_of(angles)), size_(frame.size) {
  std::vector<Point> points;
  for (const Point& p : frame.points) points.push_back(seen(p));
  const mesh::Bounds box = mesh::bounds(points);
  middle_ = box.center();
  const glm::vec2 room = size_ - 2.0f * frame.margin;
  scale_ = std::min(room.x / (box.high[0] - box.low[0]), room.y / (box.high[1] - box.low[1]));
}

Vec3 PictureView::seen(const Point& p) const {
  Vec3 result;
  for (int i = 0; i < 3; ++i)
    result[i] = turn_[3 * i] * p[0] + turn_[3 * i + 1] * p[1] + turn_[3 * i + 2] * p[2];
  return result;
}

glm::vec2 PictureView::at(const Point& p) const {
  const Vec3 s = seen(p);
  return 0.5f * size_ + glm::vec2(scale_ * (s[0] - middle_[0]), -scale_ * (s[1] - middle_[1]));
}

std::vector<PictureShape> lit_model(const PictureView& view, const mesh::Surface& model,
                                    std::span<const Point> at) {
  constexpr double seen_from_the_side = 1e-9;
  std::vector<std::pair<double, std::size_t>> found;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    const Corners corners = corners_of(model, p);
    if (normal_of(view, corners, at)[2] > seen_from_the_side)
      found.emplace_back(nearness(view, corners, at), p);
  }
  std::ranges::sort(found);
  std::vector<PictureShape> shapes;
  for (const auto& [near, p] : found) {
    const Corners corners = corners_of(model, p);
    PictureShape& shape = shapes.emplace_back();
    for (const auto v : corners) shape.points.push_back(view.at(at[v]));
    std::ranges::reverse(shape.points);
    const auto last = model.polygon_starts[p + 1] - 1;
    for (const auto& [i, j, k] : mesh::clipped_of(model, p))
      shape.triangles.push_back({last - i, last - j, last - k});
    shape.tone = lightness(normal_of(view, corners, at));
  }
  return shapes;
}

}  // namespace viete::workspace
