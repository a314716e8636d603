// The table of file formats and their capabilities. To add a format, add a reader, a writer and a row.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "formats/format.h"
#include "formats/original.h"

namespace viete::formats {

/// All formats, in the order of menus and messages.
std::span<const Format> all_formats();

/// Both return null for an unknown extension.
const Format* format_by_extension(std::string_view extension);
const Format* find_format(const std::filesystem::path& file);

/// The format of a surface file by its extension. If it is unknown, throws base::Error with all extensions.
const Format& surface_format(const std::filesystem::path& file);

/// True if `file` has the format of the original, which can then be rewritten. original may be null.
bool writes_itself(const Original* original, const std::filesystem::path& file);

/// Detects the format by content with Format::is_certain, ignoring the extension. Null if unknown.
const Format* format_of_content(const std::filesystem::path& file, const Beginning& beginning);

/// The row for a ReadResult::format such as "glTF binary"; null if unknown.
const Format* format_of_description(std::string_view description);

/// Lists the names of the formats that satisfy `is`: "OBJ, PLY or OFF". last: the text before the last name.
std::string format_names(bool (*is)(const Format&), std::string_view last = " or ");
/// Lists their extensions: ".obj, .ply or .off".
std::string format_extensions(bool (*is)(const Format&), std::string_view last = " or ");
/// The name of a mesh argument in the command-line help: "Mesh (OBJ, PLY, OFF, STL, glTF)".
std::string a_mesh();

constexpr bool holds_surface(const Format& f) {
  return f.read != nullptr;
}
constexpr bool keeps_order(const Format& f) {
  return f.keeps_order;
}
constexpr bool holds_morphs(const Format& f) {
  return f.holds_morphs;
}
constexpr bool holds_one_frame(const Format& f) {
  return f.read != nullptr && !f.holds_morphs;
}
constexpr bool is_sequence(const Format& f) {
  return f.is_sequence;
}

/// Applies `is` to the format of the file's extension; returns false for an unknown extension.
bool is_a(bool (*is)(const Format&), const std::filesystem::path& file);

}  // namespace viete::formats
