// Object File Format (OFF), text.
#pragma once

#include <string>
#include <vector>

#include "mesh/formats/original.h"
#include "mesh/formats/source.h"
#include "mesh/formats/text_cursor.h"
#include "mesh/formats/text_writer.h"

namespace viete::mesh {

/// Source: Geomview manual, "OFF Files". Read: OFF and its forms with colours, normals or texture coordinates
/// behind the positions, named in any order; comments; the word OFF itself may be missing, and colours stand
/// in files that do not name them. White space is all alike but for the line end behind a face, which ends
/// its colour: files are read row by row, and where that fails with line ends as blanks among the numbers of
/// faces, then of vertices. Not read: 4OFF, nOFF, BINARY. Throws base::Error, base::Cancelled.
ReadResult read_off(const Source& source);

/// True if the first word is OFF or one of its forms.
bool looks_like_off(const Source& source);

/// True if numbers alone follow, and enough of them for the counts that they begin with.
bool is_certainly_off(const Beginning& file);

void write_off(const Content& content, TextWriter& out);

}  // namespace viete::mesh
