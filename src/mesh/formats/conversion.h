// What becomes of a file's attributes when its surface is written in another format.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesh/formats/attributes.h"
#include "mesh/formats/format.h"
#include "mesh/formats/original.h"
#include "mesh/formats/text_writer.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// The attributes as a deformation of the surface leaves them: normals follow.
Attributes deformed_attributes(const Surface& rest, std::span<const Point> positions,
                               const Attributes& attributes);

/// Each of a file's normals once for every vertex whose corners use it, or for every polygon where the file
/// asks for flat faces: these may differ once the surface is deformed.
struct SpreadNormals {
  std::vector<Vec3> normals;
  std::vector<std::uint32_t> first;      ///< of each of the file's normals, one or more each; and the end
  std::vector<std::uint32_t> of_corner;  ///< or none

  /// attributes has normals and indices of corners.
  SpreadNormals(const Surface& surface, const Attributes& attributes);
};

/// Of each vertex the index that all its corners have, none where it has no corner; nothing where corners of
/// one vertex differ.
std::optional<std::vector<std::uint32_t>> one_a_vertex(const Surface& surface,
                                                       const std::vector<std::uint32_t>& of_corner);

/// True if the file asks for flat faces everywhere.
bool is_flat(const Attributes& attributes);

/// From 0 to 255.
std::uint8_t color_byte(float value);

/// All that the result lacks of the content and of the file that it was read from (null: none), one line
/// each: "PLY does not get what else was in the file: groups, materials", "2 faces of more than three corners
/// became triangles". deformed: see deformed_attributes().
std::vector<std::string> left_out(const Format& format, const Content& content, const Attributes& deformed,
                                  const Original* original);

}  // namespace viete::mesh
