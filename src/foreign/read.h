// The formats that the program viete-import reads. Reads a surface from a file of any format.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "base/progress.h"
#include "formats/original.h"

namespace viete::foreign {

struct Kind {
  std::string_view extension;  ///< lower case, without the dot
  std::string_view name;       ///< for messages; ReadResult::format
};

/// The kinds, common ones first.
std::span<const Kind> all_kinds();

/// Returns the formats of models for help texts: "OBJ, PLY, OFF, STL, glTF, SPZ, FBX and others".
std::string model_formats();
/// Returns the text for a mesh argument in the command-line help: "Mesh (OBJ, ...)".
std::string a_mesh();

/// Returns the kind of a file by its extension, or null if the format is not foreign.
const Kind* kind_of(const std::filesystem::path& file);

/// Works like formats::read(). If the format is foreign or the file is a compressed glTF file, runs the
/// program viete-import: $VIETE_IMPORT, the program beside this program, or the program in PATH. If it is not
/// installed, crashes, or takes more than `most_seconds`, throws base::Error. If `progress` is cancelled,
/// ends it.
formats::ReadResult read(const std::filesystem::path& path, base::Progress* progress = nullptr,
                         bool played = false, double most_seconds = 600);

}  // namespace viete::foreign
