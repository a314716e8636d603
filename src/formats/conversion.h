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

/// Copies of normals. If several vertices or flat-shaded polygons have the same normal, each gets a copy. A
/// deformation can then change each copy separately.
struct SpreadNormals {
  std::vector<mesh::Vec3> normals;   ///< all copies of original normal 0, then all copies of normal 1, ...
  std::vector<std::uint32_t> first;  ///< index of each original normal's first copy; last: normals.size()
  std::vector<std::uint32_t> of_corner;  ///< for each corner an index into normals, or mesh::none

  /// `attributes` must have normals and corner indices.
  SpreadNormals(const mesh::Surface& surface, const Attributes& attributes);
};

/// `of_corner` has an index or mesh::none for each corner. If no vertex has two different indices, returns
/// the index of each vertex, or mesh::none for a vertex without an index. Otherwise, returns nullopt.
std::optional<std::vector<std::uint32_t>> one_a_vertex(const mesh::Surface& surface,
                                                       const std::vector<std::uint32_t>& of_corner);

/// Returns true if there are groups and all groups have flat shading.
bool is_flat(const Attributes& attributes);

/// A colour in a text file. Components are from 0 to 1 or from 0 to 255.
struct WrittenColor {
  std::uint32_t element = 0;  ///< index of the vertex or polygon
  Color color{};
  bool whole = true;  ///< true if red, green and blue are integers

  /// `numbers` and `are_whole` are the results of TextCursor::numbers(): three or four, or none for black.
  WrittenColor(std::size_t element, std::span<const double> numbers, std::span<const bool> are_whole);
};

/// Returns the colour of each element, in [0, 1], or no colours if `written` is empty. Elements without a
/// colour get `missing`. If one of the whole colours exceeds 1, divides all whole colours by 255; likewise
/// for the other colours. Opacities up to 1 stay.
std::vector<Color> colors_of_elements(std::span<const WrittenColor> written, std::size_t elements,
                                      const Color& missing);

/// Converts a value in [0, 1] to an integer from 0 to 255. Values outside are clamped.
std::uint8_t color_byte(float value);

/// Returns messages about content that this format cannot store, one line each: "2 faces of more than three
/// corners became triangles". `deformed` is the result of deformed_attributes(). `original` may be null.
std::vector<std::string> left_out(const Format& format, const Content& content, const Attributes& deformed,
                                  const Original* original);

}  // namespace viete::formats
