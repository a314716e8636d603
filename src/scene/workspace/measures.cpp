#include "scene/workspace/measures.h"

namespace viete::scene {

Measures measure(const Document& document, const PosedModel& posed) {
  const mesh::Surface& model = *document.model.surface;
  const mesh::Point center = document.model.bounds.center();
  Measures sum;
  for (const auto& t : model.triangles) {
    const mesh::Vec3 a = posed.at(model, t[0]) - center, b = posed.at(model, t[1]) - center,
                     c = posed.at(model, t[2]) - center;
    const mesh::Vec3 normal = mesh::cross(b - a, c - a);
    sum.area += 0.5 * mesh::norm(normal);
    sum.volume += mesh::dot(a, normal) / 6;
  }
  return sum;
}

mesh::Point place_of(const Document& document, const PosedModel& posed, const SurfacePoint& point) {
  const mesh::Surface& model = *document.model.surface;
  const mesh::Triangle& t = model.triangles[point.triangle];
  mesh::Point place{0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) place = place + point.shares[k] * posed.at(model, t[k]);
  return place;
}

const Measures& measure(const Document& document, const PosedModel& posed, KnownMeasures& known) {
  const bool is_posed = !posed.vertices.empty();
  if (known.of != document.revisions() || known.posed != is_posed || known.frame != posed.frame)
    known = {document.revisions(), is_posed, posed.frame, measure(document, posed)};
  return known.now;
}

}  // namespace viete::scene
