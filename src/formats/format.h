// Description of a file format: a row of format_table.h.
#pragma once

#include <string_view>

#include "formats/original.h"
#include "formats/source.h"
#include "formats/text_writer.h"

namespace viete::formats {

/// Surface content that a format can store besides positions and triangles.
namespace held {
enum What : unsigned {
  polygons = 1 << 0,
  points = 1 << 1,  ///< surfaces without faces
  texture_points = 1 << 2,
  colors = 1 << 3,
  polygon_colors = 1 << 4,
  normals = 1 << 5,        ///< at least one normal per vertex
  corner_normals = 1 << 6  ///< also several per vertex
};
}  // namespace held

struct Format {
  std::string_view extension;  ///< lower case, without the dot
  std::string_view name;       ///< for messages; common to all extensions of the format

  ReadResult (*read)(const Source&) = nullptr;  ///< reads a surface; null if the format has none
  bool (*recognised)(const Source&) = nullptr;  ///< detection by content; null: only by extension
  /// A stricter test, used before overwriting a file. False for other content with a similar beginning.
  bool (*is_certain)(const Beginning&) = nullptr;
  void (*write)(const Content&, TextWriter&) = nullptr;

  bool may_be_binary = false;  ///< even if its content is not recognised
  bool keeps_order = false;    ///< keeps the vertex order, which poses and keys rely on
  bool holds_morphs = false;
  bool is_sequence = false;  ///< positions only, frame after frame
  char up = 0;               ///< up axis by convention: 'y' or 'z'; 0: none
  bool in_metres = false;
  unsigned all_held = 0;  ///< bits of held::What

  constexpr bool holds(held::What what) const { return (all_held & what) != 0; }
};

}  // namespace viete::formats
