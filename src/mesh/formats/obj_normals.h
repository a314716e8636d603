// The normals of an OBJ file after a deformation: one line of the file may have to become several.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/formats/attributes.h"
#include "mesh/formats/printed.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// A line `vn` serves any number of corners. Once the surface is deformed, it stands for one normal at each
/// vertex that uses it, and at each polygon where the file asks for flat faces. Those that are printed
/// differently get lines of their own, behind the block of lines that theirs stands in.
class ObjNormals {
public:
  /// blocks: of each block of lines `vn` the number of such lines up to its end, ascending; the last is that
  /// of the file. attributes has normals.
  ObjNormals(const Surface& rest, const Attributes& attributes, std::span<const std::uint32_t> blocks,
             std::span<const Point> positions, const Printed& printed);

  /// What the file's line says now; its bits are those it had if nothing moved there.
  const Vec3& of_line(std::size_t line) const { return values_[first_[line]]; }
  /// What the lines say that are added for it.
  std::span<const Vec3> added(std::size_t line) const {
    return std::span(values_).subspan(first_[line] + 1, first_[line + 1] - first_[line] - 1);
  }
  bool adds_lines() const { return values_.size() + 1 > first_.size(); }

  /// Indices from 0 among all lines `vn` of the new file.
  std::uint32_t index_of_line(std::size_t line) const { return index_[line]; }
  std::uint32_t index_of_corner(std::size_t corner) const { return corner_index_[corner]; }

private:
  void number(std::span<const std::uint32_t> blocks, const Attributes& attributes,
              std::span<const std::uint32_t> value_of_corner);

  std::vector<Vec3> values_;          // of each line, and of those added for it
  std::vector<std::uint32_t> first_;  // of the values of each line
  std::vector<std::uint32_t> index_;
  std::vector<std::uint32_t> corner_index_;  // where lines are added
};

}  // namespace viete::mesh
