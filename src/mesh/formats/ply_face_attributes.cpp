#include "mesh/formats/ply_face_attributes.h"

#include <algorithm>
#include <cmath>

#include "mesh/formats/ply_attributes.h"
#include "mesh/formats/source.h"

namespace viete::mesh {

void PlyFaceAttributes::begin(const PlyElement& faces, const Surface& surface) {
  surface_ = &surface;
  const std::size_t none_such = faces.properties.size();
  slots_.assign(none_such, slots);
  factors_.assign(none_such, 1);
  row_ = {0, 0, 0, 1, 0};
  const auto find = [&](const char* name, std::size_t slot, bool is_color) {
    const std::size_t p = faces.find(name);
    if (p == none_such || faces.properties[p].list_size) return false;
    slots_[p] = slot;
    if (is_color) factors_[p] = part_of_largest(faces.properties[p].type);
    return true;
  };
  has_colors_ = find("red", color, true) && find("green", color + 1, true) && find("blue", color + 2, true);
  find("alpha", color + 3, true);
  has_number_ = find("texnumber", number, false);
  texture_list_ = faces.find("texcoord");
  if (texture_list_ < none_such && !faces.properties[texture_list_].list_size) texture_list_ = none_such;
}

void PlyFaceAttributes::end_row() {
  const std::size_t polygons = surface_->polygon_count();
  if (has_colors_ && polygons > polygons_) {
    colors_.resize(polygons_, Material{}.base_color);
    Color& c = colors_.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) c[i] = static_cast<float>(std::clamp(row_[color + i], 0.0, 1.0));
    colors_.resize(polygons, Color(c));
  }
  end_texture();
  end_material();
  polygons_ = polygons;
  corners_ = surface_->corners.size();
  row_texture_.clear();
}

// A list of another length than the polygon's says nothing.
void PlyFaceAttributes::end_texture() {
  const std::size_t corners = surface_->corners.size() - corners_;
  if (corners == 0 || row_texture_.size() != 2 * corners) return;
  corner_texture_.resize(corners_, none);
  for (std::size_t i = 0; i < row_texture_.size(); i += 2) {
    const Point p{row_texture_[i] + 0.0, row_texture_[i + 1] + 0.0, 0};  // -0 becomes 0
    corner_texture_.push_back(texture_index_.find_or_add(p, texture_points_));
    if (corner_texture_.back() == texture_points_.size()) texture_points_.push_back(p);
  }
}

void PlyFaceAttributes::end_material() {
  if (!has_number_ || surface_->polygon_count() == polygons_) return;
  const double n = row_[number];
  const std::uint32_t material = n >= 0 && n < 65536 ? static_cast<std::uint32_t>(n) : none;
  if (!groups_.empty() && groups_.back().material == material) return;
  if (groups_.empty() && polygons_ > 0) groups_.emplace_back();
  groups_.push_back({static_cast<std::uint32_t>(polygons_), "", "", material});
}

void PlyFaceAttributes::finish(const Surface& surface, const std::vector<std::string>& images,
                               const std::filesystem::path& folder, Attributes& attributes) {
  if (!colors_.empty()) {
    colors_.resize(surface.polygon_count(), Material{}.base_color);
    attributes.polygon_colors = std::move(colors_);
  }
  if (!texture_points_.empty()) {
    attributes.texture_points.clear();
    for (const Point& p : texture_points_) attributes.texture_points.push_back({p[0], p[1]});
    corner_texture_.resize(surface.corners.size(), none);
    attributes.corner_texture = std::move(corner_texture_);
  }
  for (const std::string& image : images) {
    if (folder.empty()) break;
    const auto path = path_beside(folder, image);
    Material material{path.stem().string(), {1, 1, 1, 1}};
    material.base_color_image = static_cast<std::uint32_t>(attributes.images.size());
    attributes.images.push_back({path, nullptr, path.filename().string()});
    attributes.materials.push_back(std::move(material));
  }
  if (!attributes.materials.empty()) finish_groups(surface, attributes);
}

void PlyFaceAttributes::finish_groups(const Surface& surface, Attributes& attributes) {
  if (surface.polygon_count() == 0) return;
  if (groups_.empty()) groups_.push_back({0, "", "", 0});
  for (Group& g : groups_) {
    if (g.material >= attributes.materials.size()) g.material = none;
  }
  attributes.groups = std::move(groups_);
}

}  // namespace viete::mesh
