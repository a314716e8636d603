// Collects colours and texture coordinates of a PLY file's faces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/formats/attributes.h"
#include "mesh/formats/ply_header.h"
#include "mesh/point_index.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// Known are red green blue alpha, a list texcoord (u v of each corner) and texnumber, as MeshLab writes
/// them.
class PlyFaceAttributes {
public:
  /// The properties of the rows that follow, which become polygons of this surface.
  void begin(const PlyElement& faces, const Surface& surface);

  bool wants(std::size_t property) const { return slots_[property] != slots; }
  bool wants_list(std::size_t property) const { return property == texture_list_; }
  void take(std::size_t property, double value) { row_[slots_[property]] = value * factors_[property]; }
  void take_texture(double value) { row_texture_.push_back(value); }
  /// The polygons that the surface has got since the last row have what was taken.
  void end_row();

  /// Puts all that was found to what the vertices have. Images, by number, lie in this folder.
  void finish(const Surface& surface, const std::vector<std::string>& images,
              const std::filesystem::path& folder, Attributes& attributes);

private:
  static constexpr std::size_t color = 0, number = 4, slots = 5;

  void end_texture();
  void end_material();
  void finish_groups(const Surface& surface, Attributes& attributes);

  const Surface* surface_ = nullptr;
  std::vector<std::size_t> slots_;  // of each property, where it goes in a row
  std::vector<double> factors_;
  std::size_t texture_list_ = 0;
  std::array<double, slots> row_{};
  std::vector<double> row_texture_;
  bool has_colors_ = false, has_number_ = false;
  std::size_t polygons_ = 0, corners_ = 0;  // up to the row before
  std::vector<Color> colors_;
  std::vector<Point> texture_points_;  // (u, v, 0)
  PointIndex texture_index_;
  std::vector<std::uint32_t> corner_texture_;
  std::vector<Group> groups_;  // of one texnumber each, which stands for the material
};

}  // namespace viete::mesh
