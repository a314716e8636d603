// Conversion of attributes to another format.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/attributes.h"
#include "formats/format_table.h"
#include "formats/original.h"
#include "formats/text_writer.h"
#include "mesh/surface.h"

namespace viete::formats {

/// The attributes with normals updated to the moved positions.
Attributes deformed_attributes(const mesh::Surface& rest, std::span<const mesh::Point> positions,
                               const Attributes& attributes);

/// A copy of each normal for each vertex that uses it, or for each polygon with flat shading. A deformation
/// may change the copies differently.
struct SpreadNormals {
  std::vector<mesh::Vec3> normals;       ///< at least one copy of each original normal, in their order
  std::vector<std::uint32_t> first;      ///< index of the first copy of each original normal, then the size
  std::vector<std::uint32_t> of_corner;  ///< for each corner an index into normals, or mesh::none

  /// attributes must have normals and corner indices.
  SpreadNormals(const mesh::Surface& surface, const Attributes& attributes);
};

/// For each vertex the common index of its corners, or mesh::none for a vertex without corners. Returns
/// nullopt if two corners of a vertex have different indices.
std::optional<std::vector<std::uint32_t>> one_a_vertex(const mesh::Surface& surface,
                                                       const std::vector<std::uint32_t>& of_corner);

/// True if the whole file has flat shading.
bool is_flat(const Attributes& attributes);

/// If a component exceeds 1, divides all colours by 255, except white (1, 1, 1, 1) and opacity 1.
void to_unit_range(std::span<Color> colors);

/// Converts a value in [0, 1] to an integer from 0 to 255. Clamps other values.
std::uint8_t color_byte(float value);

/// Messages about content that this format cannot store, one line each: "2 faces of more than three corners
/// became triangles". original: the file that was read, or null. deformed: see deformed_attributes().
std::vector<std::string> left_out(const Format& format, const Content& content, const Attributes& deformed,
                                  const Original* original);

}  // namespace viete::formats
