// Object File Format (OFF), text.
#pragma once

#include <string>
#include <vector>

#include "mesh/formats/original.h"
#include "mesh/formats/source.h"
#include "mesh/formats/text_cursor.h"
#include "mesh/formats/text_writer.h"

namespace viete::mesh {

/// Source: Geomview manual, "OFF Files". Reads OFF and its variants with colours, normals or texture
/// coordinates after positions, in any order; comments; files without the keyword OFF; undeclared colours.
/// Only the line end after a face is significant, as it ends the face's colour: reading is row by row; if
/// that fails, line ends among face numbers, then among vertex numbers, count as blanks. Not supported: 4OFF,
/// nOFF, BINARY. Throws base::Error, base::Cancelled.
ReadResult read_off(const Source& source);

/// True if the first word is OFF or a variant.
bool looks_like_off(const Source& source);

/// True if only numbers follow, and enough of them for the declared counts.
bool is_certainly_off(const Beginning& file);

void write_off(const Content& content, TextWriter& out);

}  // namespace viete::mesh
