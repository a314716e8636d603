// Converts attributes for another file format.
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

/// Returns the attributes with normals that match the moved positions.
Attributes deformed_attributes(const mesh::Surface& rest, std::span<const mesh::Point> positions,
                               const Attributes& attributes);

/// Normals with a copy for each vertex that uses the normal, or for each polygon if shading is flat. A
/// deformation may change the copies differently.
struct SpreadNormals {
  std::vector<mesh::Vec3> normals;       ///< at least one copy of each original normal, in the original order
  std::vector<std::uint32_t> first;      ///< index of each original normal's first copy; then normals.size()
  std::vector<std::uint32_t> of_corner;  ///< for each corner an index into normals, or mesh::none

  /// `attributes` must have normals and corner indices.
  SpreadNormals(const mesh::Surface& surface, const Attributes& attributes);
};

/// Returns for each vertex the index that all its corners have, or mesh::none for a vertex without corners.
/// If two corners of a vertex have different indices, returns nullopt.
std::optional<std::vector<std::uint32_t>> one_a_vertex(const mesh::Surface& surface,
                                                       const std::vector<std::uint32_t>& of_corner);

/// Returns true if the whole file has flat shading.
bool is_flat(const Attributes& attributes);

/// If a component exceeds 1, divides all colours by 255, but not white (1, 1, 1, 1) and not an opacity of 1.
void to_unit_range(std::span<Color> colors);

/// Converts a value in [0, 1] to an integer from 0 to 255. Values outside are clamped.
std::uint8_t color_byte(float value);

/// Returns messages about content that this format cannot store, one line each: "2 faces of more than three
/// corners became triangles". original: the file that was read, or null. deformed: see deformed_attributes().
std::vector<std::string> left_out(const Format& format, const Content& content, const Attributes& deformed,
                                  const Original* original);

}  // namespace viete::formats
