#include "document/up_axis.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "formats/format_table.h"
#include "mesh/vector.h"

namespace viete::document {

namespace {

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

// The area of the box around the model's lowest points, relative to the bounding box seen from above. 0 if
// it would fall over.
double standing(const mesh::Surface& surface, const mesh::Bounds& box, const mesh::Point& middle,
                std::size_t axis) {
  const double lowest = box.low[axis] + 0.02 * (box.high[axis] - box.low[axis]);
  std::vector<mesh::Point> feet;
  std::ranges::copy_if(surface.positions, std::back_inserter(feet),
                       [&](const mesh::Point& p) { return p[axis] <= lowest; });
  if (feet.size() < 3) return 0;
  const mesh::Bounds base = mesh::bounds(feet);
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
