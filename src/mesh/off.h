// Object File Format (OFF), text.
#pragma once

#include <string>
#include <vector>

#include "mesh/read.h"
#include "mesh/source.h"
#include "mesh/text_cursor.h"
#include "mesh/text_writer.h"

namespace viete::mesh {

inline constexpr TextRules off_rules{.comment = '#'};

/// What the rows of vertices hold behind positions, and where.
struct OffForm {
  bool normals = false, colors = false, texture = false;
  bool more_axes = false;     ///< 4OFF, nOFF
  bool colors_first = false;  ///< of four numbers before the normals, as MeshLab writes them
  bool wrapped = false;       ///< rows end with their last number, not with the line

  std::size_t numbers() const { return (normals ? 3U : 0U) + (colors ? 4U : 0U) + (texture ? 2U : 0U); }
};

/// Source: Geomview manual, "OFF Files". Read: OFF and its forms with colours, normals or texture coordinates
/// behind the positions, named in any order; comments; the word OFF itself may be missing, and colours stand
/// in files that do not name them. White space is all alike but for the line end behind a face, which ends
/// its colour: files are read row by row, and where that fails with line ends as blanks among the numbers of
/// faces, then of vertices. Not read: 4OFF, nOFF, BINARY. Throws base::Error, base::Cancelled.
ReadResult read_off(const Source& source);

/// True if the first word is OFF or one of its forms.
bool looks_like_off(const Source& source);

void write_off(const Content& content, TextWriter& out);

}  // namespace viete::mesh
