#include "deform/all_element_maps.h"

#include <algorithm>
#include <utility>

#include "deform/corner_maps.h"
#include "deform/face_maps.h"
#include "deform/patch_maps.h"

namespace viete::deform {

namespace {

mesh::Adjacency corners_of_triangles(const Cage& cage) {
  return mesh::make_adjacency(cage.element_count(), [&](const auto& add) {
    for (std::uint32_t e = 0; e < cage.element_count(); ++e) {
      for (const auto v : cage.surface.triangles[e]) add(e, v);
    }
  });
}

class FaceMaps : public ElementMaps {
public:
  explicit FaceMaps(const Cage& cage)
      : ElementMaps(face_graph(cage), corners_of_triangles(cage)), cage_(cage) {}

  void compute(std::span<const mesh::Point> posed, const Vec3& origin, std::span<const std::uint32_t> which,
               std::span<AffineMap> maps) const override {
    face_maps(cage_, posed, origin, which, maps);
  }

private:
  const Cage& cage_;
};

}  // namespace

std::unique_ptr<const ElementMaps> element_maps(const Cage& cage, Elements elements, bool as_before) {
  switch (elements) {
    case Elements::face:
    case Elements::point: break;
    case Elements::polygon: return polygon_maps(cage);
    case Elements::patch: return face_patch_maps(cage, size_of(cage, as_before));
    case Elements::vertex_patch: return vertex_patch_maps(cage, size_of(cage, as_before));
    case Elements::edge: return edge_maps(cage);
    case Elements::vertex: return vertex_maps(cage);
    case Elements::vertex_face: return vertex_face_maps(cage);
  }
  return std::make_unique<FaceMaps>(cage);
}

}  // namespace viete::deform
