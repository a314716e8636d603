// Conversion of a file's attributes to another format.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/attributes.h"
#include "formats/format.h"
#include "formats/original.h"
#include "formats/text_writer.h"
#include "mesh/surface.h"

namespace viete::formats {

/// Attributes after a deformation of the surface: recomputes normals.
Attributes deformed_attributes(const mesh::Surface& rest, std::span<const mesh::Point> positions,
                               const Attributes& attributes);

/// Normals split per vertex, or per polygon where the file has flat shading: vertices and polygons that share
/// a normal may need different ones after a deformation.
struct SpreadNormals {
  std::vector<mesh::Vec3> normals;
  std::vector<std::uint32_t> first;      ///< start of each source normal's copies (one at least), and the end
  std::vector<std::uint32_t> of_corner;  ///< index into normals, or none

  /// attributes must have normals and corner indices.
  SpreadNormals(const mesh::Surface& surface, const Attributes& attributes);
};

/// For each vertex the index shared by its corners, or `none` for a vertex without corners. nullopt if the
/// corners of a vertex differ.
std::optional<std::vector<std::uint32_t>> one_a_vertex(const mesh::Surface& surface,
                                                       const std::vector<std::uint32_t>& of_corner);

/// True if the whole file has flat shading.
bool is_flat(const Attributes& attributes);

/// Scales colours to [0, 1] if one has a number above 1, which means 0 to 255. White and full opacity stay.
void to_unit_range(std::span<Color> colors);

/// Converts a value in [0, 1] to a byte, 0 to 255.
std::uint8_t color_byte(float value);

/// Describes the content lost in this format, one line each: "PLY does not get what else was in the file:
/// groups, materials", "2 faces of more than three corners became triangles". original: the file that was
/// read, or null. deformed: see deformed_attributes().
std::vector<std::string> left_out(const Format& format, const Content& content, const Attributes& deformed,
                                  const Original* original);

}  // namespace viete::formats
