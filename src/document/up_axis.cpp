#include "document/up_axis.h"

#include "base/worker_pool.h"
#include "formats/format_table.h"
#include "mesh/triangle.h"
#include "mesh/vector.h"

namespace viete::document {

namespace {

mesh::Point centroid(const mesh::Surface& surface) {
  struct Sum {
    mesh::Point moment{0, 0, 0};
    double area = 0;
    Sum operator+(const Sum& other) const { return {moment + other.moment, area + other.area}; }
  };
  const Sum sum = base::sum_of_blocks(surface.triangles.size(), [&](std::size_t begin, std::size_t end) {
    Sum sum;
    for (std::size_t t = begin; t < end; ++t) {
      const auto [a, b, c] = mesh::corners_of(surface.positions, surface.triangles[t]);
      const double area = mesh::norm(mesh::cross(b - a, c - a));
      sum = sum + Sum{(area / 3) * (a + b + c), area};
    }
    return sum;
  });
  return sum.area > 0 ? (1 / sum.area) * sum.moment : sum.moment;
}

// Returns the area of the box around the model's lowest points, divided by the area of the bounding box as
// seen from above. If the center of the model is not above this box, returns 0: the model would fall over.
double standing(const mesh::Surface& surface, const mesh::Bounds& box, const mesh::Point& middle,
                std::size_t axis) {
  const double lowest = box.low[axis] + 0.02 * (box.high[axis] - box.low[axis]);
  std::size_t feet = 0;
  mesh::Bounds base{box.high, box.low};
  for (const mesh::Point& p : surface.positions)
    if (p[axis] <= lowest) mesh::extend(base, p), ++feet;
  if (feet < 3) return 0;
  double share = 1;
  for (const std::size_t k : {(axis + 1) % 3, (axis + 2) % 3}) {
    if (middle[k] < base.low[k] || middle[k] > base.high[k] || !(box.high[k] > box.low[k])) return 0;
    share *= (base.high[k] - base.low[k]) / (box.high[k] - box.low[k]);
  }
  return share;
}

}  // namespace

UpAxis guessed_up(const OpenedSurface& model) {
  constexpr double matters = 0.05;
  const formats::Format* format = formats::format_of_description(model.format);
  if (format && format->up) return format->up == 'z' ? UpAxis::z : UpAxis::y;
  if (model.surface->triangles.empty()) return UpAxis::y;
  const mesh::Point middle = centroid(*model.surface);
  const double y = standing(*model.surface, model.bounds, middle, 1),
               z = standing(*model.surface, model.bounds, middle, 2);
  return z > matters && z > 3 * y ? UpAxis::z : UpAxis::y;
}

}  // namespace viete::document
