// The formats that the program viete-import reads.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

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

}  // namespace viete::foreign
