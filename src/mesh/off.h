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

/// Source: Geomview manual, "OFF Files". Read: OFF and its forms with colours, normals or texture coordinates
/// behind the positions; comments; the word OFF itself may be missing. Not read: 4OFF,
/// nOFF, BINARY. Throws base::Error, base::Cancelled.
ReadResult read_off(const Source& source);

/// True if the first word is OFF or one of its forms.
bool looks_like_off(const Source& source);

void write_off(const Content& content, TextWriter& out);

}  // namespace viete::mesh
