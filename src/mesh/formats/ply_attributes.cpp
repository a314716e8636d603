#include "mesh/formats/ply_attributes.h"

#include <algorithm>

namespace viete::mesh {

double part_of_largest(PlyType type) {
  switch (type) {
    case PlyType::int8: return 1.0 / 127;
    case PlyType::uint8: return 1.0 / 255;
    case PlyType::int16: return 1.0 / 32767;
    case PlyType::uint16: return 1.0 / 65535;
    case PlyType::int32: return 1.0 / 255;  // bytes in text, as some programs declare them
    case PlyType::uint32: return 1.0 / 255;
    case PlyType::int64: return 1.0 / 255;
    case PlyType::uint64: return 1.0 / 255;
    default: return 1;
  }
}

// True if the element has single values of all these names: they go to the slots from this one on.
bool PlyAttributes::find(const PlyElement& vertices, std::size_t slot,
                         std::initializer_list<const char*> names) {
  const std::size_t none_such = vertices.properties.size();
  for (const char* name : names) {
    const std::size_t p = vertices.find(name);
    if (p == none_such || vertices.properties[p].list_size) return false;
  }
  for (const char* name : names) {
    const std::size_t p = vertices.find(name);
    if (slot >= color && slot < texture) factors_[p] = part_of_largest(vertices.properties[p].type);
    slots_[p] = slot++;
  }
  return true;
}

PlyAttributes& PlyAttributes::begin(const PlyElement& vertices) {
  slots_.assign(vertices.properties.size(), slots);
  factors_.assign(vertices.properties.size(), 1);
  row_[color + 3] = 1;
  has_normals_ = find(vertices, normal, {"nx", "ny", "nz"});
  has_colors_ = find(vertices, color, {"red", "green", "blue"}) ||
                find(vertices, color, {"diffuse_red", "diffuse_green", "diffuse_blue"});
  if (has_colors_) find(vertices, color + 3, {"alpha"});
  for (const auto& [u, v] :
       {std::array{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}) {
    if (!has_texture_) has_texture_ = find(vertices, texture, {u, v});
  }
  return *this;
}

void PlyAttributes::end_row() {
  if (has_normals_) found_.normals.push_back({row_[normal], row_[normal + 1], row_[normal + 2]});
  if (has_texture_) found_.texture_points.push_back({row_[texture], row_[texture + 1]});
  if (!has_colors_) return;
  Color& c = found_.colors.emplace_back();
  for (std::size_t i = 0; i < 4; ++i) c[i] = static_cast<float>(std::clamp(row_[color + i], 0.0, 1.0));
}

Attributes PlyAttributes::finish(const Surface& surface) {
  if (has_normals_) found_.corner_normal = surface.corners;
  if (has_texture_) found_.corner_texture = surface.corners;
  return std::move(found_);
}

}  // namespace viete::mesh
