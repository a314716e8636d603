// What there is to say of a file format: a row of format_table.h.
#pragma once

#include <string_view>

#include "mesh/formats/original.h"
#include "mesh/formats/source.h"
#include "mesh/formats/text_writer.h"

namespace viete::mesh {

/// What a format takes of a surface beside positions and triangles.
namespace held {
enum What : unsigned {
  polygons = 1 << 0,
  points = 1 << 1,  ///< of a surface without faces
  texture_points = 1 << 2,
  colors = 1 << 3,
  polygon_colors = 1 << 4,
  normals = 1 << 5,        ///< one of each vertex at least,
  corner_normals = 1 << 6  ///< and several
};
}  // namespace held

struct Format {
  std::string_view extension;  ///< lower case, without the dot
  std::string_view name;       ///< in messages; one for all extensions of a format

  ReadResult (*read)(const Source&) = nullptr;  ///< of a surface; null: none is in it
  bool (*recognised)(const Source&) = nullptr;  ///< by its content; null: a name must tell
  /// More strictly: a result may replace the file. False for other content that begins alike.
  bool (*is_certain)(const Beginning&) = nullptr;
  void (*write)(const Content&, TextWriter&) = nullptr;

  bool may_be_binary = false;  ///< although its content is not recognised
  bool keeps_order = false;    ///< of vertices, which poses and keys go by
  bool holds_morphs = false;
  bool is_sequence = false;  ///< positions alone, frame after frame
  char up = 0;               ///< the axis that files of it agree on: 'y' or 'z'; 0: none
  bool in_metres = false;
  unsigned all_held = 0;  ///< of held::What

  constexpr bool holds(held::What what) const { return (all_held & what) != 0; }
};

}  // namespace viete::mesh
