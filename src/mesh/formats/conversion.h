// What becomes of a file's attributes when its surface is written in another format.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
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

/// Of each vertex the index that all its corners have, none where it has no corner; nothing where corners of
/// one vertex differ.
std::optional<std::vector<std::uint32_t>> one_a_vertex(const Surface& surface,
                                                       const std::vector<std::uint32_t>& of_corner);

/// What a format cannot hold of the attributes that were given, see deformed_attributes(), one line each:
/// "STL has no texture coordinates: 1,234 left out".
std::vector<std::string> left_out(const Format& format, const Surface& surface, const Attributes& given,
                                  const Attributes& deformed);

/// The same of what the file held besides, as one line.
std::vector<std::string> left_out(const Format& format, const Original& original);

std::string short_number(float value);
/// From 0 to 255.
std::uint8_t color_byte(float value);

/// Makes them different, of one line and never empty, as material libraries want them.
void name_materials(Attributes& attributes);

/// Groups without a material behind others that have one get a plain one, where a format cannot say that
/// there is none.
void fill_in_materials(Attributes& attributes);

/// Where a format has no colours of faces, but materials: as many materials and groups, if there are none,
/// and the colours no more than a thousand.
void colors_to_materials(Attributes& attributes);

/// Objects, or groups where these have no objects, in the order of the file.
struct Objects {
  std::vector<std::string> names;
  std::vector<std::uint32_t> of_group;  ///< of each of Attributes::groups, a number of `names`
};

/// A single one without a name where several share vertices: apart, they would have gaps between them.
Objects objects_of(const Surface& surface, const Attributes& attributes);

/// Where a format holds triangles alone, what became of all else, one line each: "2 faces of more than three
/// corners became triangles", "3 points of no face are left out".
std::vector<std::string> triangles_notes(const Format& format, const Surface& surface);

/// Of the images that materials use for their base colour.
std::set<std::uint32_t> used_images(const Attributes& attributes);

/// A library of the materials, see name_materials(): names, colours, and images with a path, as this is
/// given.
std::string material_library(const Attributes& attributes);

}  // namespace viete::mesh
