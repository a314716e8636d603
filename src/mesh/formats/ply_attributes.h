// Collects normals, colours and texture coordinates of a PLY file's vertices.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mesh/formats/attributes.h"
#include "mesh/formats/ply_header.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// What a colour of this type is multiplied by.
double part_of_largest(PlyType type);

/// Known are nx ny nz; red green blue alpha, with diffuse_ before them too; s t, u v, and texture_ before
/// these. Colours in whole numbers are parts of their type's largest.
class PlyAttributes {
public:
  /// The properties of the vertices that follow.
  PlyAttributes& begin(const PlyElement& vertices);

  bool wants(std::size_t property) const { return slots_[property] != slots; }
  void take(std::size_t property, double value) { row_[slots_[property]] = value * factors_[property]; }
  void end_row();

  Attributes finish(const Surface& surface);

private:
  static constexpr std::size_t normal = 0, color = 3, texture = 7, slots = 9;

  bool find(const PlyElement& vertices, std::size_t slot, std::initializer_list<const char*> names);

  std::vector<std::size_t> slots_;  // of each property, where it goes in a row
  std::vector<double> factors_;
  std::array<double, slots> row_{};
  bool has_normals_ = false, has_colors_ = false, has_texture_ = false;
  Attributes found_;
};

}  // namespace viete::mesh
