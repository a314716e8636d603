// Describes a file format. format_table.h lists all formats.
#pragma once

#include <string_view>

#include "formats/original.h"
#include "formats/source.h"
#include "formats/text_writer.h"

namespace viete::formats {

/// Content that a format can store besides positions and triangles.
namespace held {
enum What : unsigned {
  polygons = 1 << 0,
  points = 1 << 1,  ///< surfaces without faces
  texture_points = 1 << 2,
  colors = 1 << 3,
  polygon_colors = 1 << 4,
  normals = 1 << 5,        ///< one normal per vertex
  corner_normals = 1 << 6  ///< several normals per vertex
};
}  // namespace held

struct Format {
  std::string_view extension;  ///< lower case, without the dot
  std::string_view name;       ///< for messages; all extensions of the format have this name

  ReadResult (*read)(const Source&) = nullptr;  ///< reads a surface; null for point caches
  bool (*recognised)(const Source&) = nullptr;  ///< detects the format by content; may be null
  /// A stricter test before a file is overwritten. It rejects other content with a similar beginning.
  bool (*is_certain)(const Beginning&) = nullptr;
  void (*write)(const Content&, TextWriter&) = nullptr;

  bool may_be_binary = false;  ///< true if read() accepts binary content that recognised() rejects
  bool keeps_order = false;    ///< true if files keep the vertex order, on which poses and keys depend
  bool holds_morphs = false;
  bool is_sequence = false;  ///< true for a point cache: positions of several frames
  char up = 0;               ///< the usual up axis, 'y' or 'z'; 0 if there is no convention
  bool in_metres = false;
  unsigned all_held = 0;  ///< a combination of held::What

  constexpr bool holds(held::What what) const { return (all_held & what) != 0; }
};

}  // namespace viete::formats
