#include "scene/document/up_axis.h"

#include <algorithm>
#include <array>
#include <vector>

#include "mesh/formats/format_table.h"
#include "mesh/vector.h"

namespace viete::scene {

namespace {

using Point2 = std::array<double, 2>;

double turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Counter-clockwise. After A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions
// (1979).
std::vector<Point2> convex_hull(std::vector<Point2> points) {
  std::ranges::sort(points);
  std::vector<Point2> hull;
  for (const bool lower : {true, false}) {
    const std::size_t begin = hull.size();
    for (const Point2& p : points) {
      while (hull.size() > begin + 1 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    if (lower) std::ranges::reverse(points);
  }
  return hull;
}

mesh::Point centroid(const mesh::Surface& surface) {
  mesh::Point sum{0, 0, 0};
  double areas = 0;
  for (const auto& t : surface.triangles) {
    const auto &a = surface.positions[t[0]], &b = surface.positions[t[1]], &c = surface.positions[t[2]];
    const double area = mesh::norm(mesh::cross(b - a, c - a));
    sum = sum + (area / 3) * (a + b + c);
    areas += area;
  }
  return areas > 0 ? (1 / areas) * sum : sum;
}

// The area of the hull of the model's lowest points, relative to the bounding box seen from above. 0 if it
// would fall over.
double standing(const mesh::Surface& surface, const mesh::Bounds& box, const mesh::Point& middle,
                std::size_t axis) {
  const std::size_t across = (axis + 1) % 3, along = (axis + 2) % 3;
  const double lowest = box.low[axis] + 0.02 * (box.high[axis] - box.low[axis]);
  std::vector<Point2> feet;
  for (const mesh::Point& p : surface.positions) {
    if (p[axis] <= lowest) feet.push_back({p[across], p[along]});
  }
  const double whole = (box.high[across] - box.low[across]) * (box.high[along] - box.low[along]);
  if (feet.size() < 3 || !(whole > 0)) return 0;
  const std::vector<Point2> hull = convex_hull(std::move(feet));
  double twice = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    if (turn(a, b, {middle[across], middle[along]}) < 0) return 0;
    twice += turn(hull[0], a, b);
  }
  return 0.5 * twice / whole;
}

}  // namespace

UpAxis guessed_up(const OpenedSurface& model) {
  constexpr double matters = 0.05;
  const mesh::Format* format = mesh::format_of_description(model.format);
  if (format && format->up) return format->up == 'z' ? UpAxis::z : UpAxis::y;
  if (model.surface->triangles.empty()) return UpAxis::y;
  const mesh::Point middle = centroid(*model.surface);
  const double y = standing(*model.surface, model.bounds, middle, 1),
               z = standing(*model.surface, model.bounds, middle, 2);
  return z > matters && z > 3 * y ? UpAxis::z : UpAxis::y;
}

}  // namespace viete::scene
