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

/// If the extension is unknown, both functions return null.
const Format* format_by_extension(std::string_view extension);
const Format* find_format(const std::filesystem::path& file);

/// Returns the format for a surface file's extension. If unknown, throws base::Error with all extensions.
const Format& surface_format(const std::filesystem::path& file);

/// Returns true if `file` has the original's format, so that it can be rewritten. original may be null.
bool writes_itself(const Original* original, const std::filesystem::path& file);

/// Detects the format by content with Format::is_certain, without the extension. Returns null if unknown.
const Format* format_of_content(const std::filesystem::path& file, const Beginning& beginning);

/// Returns the format for a ReadResult::format such as "glTF binary", or null if unknown.
const Format* format_of_description(std::string_view description);

/// Returns the names of the formats that satisfy `is`: "OBJ, PLY or OFF". `last` precedes the last name.
std::string format_names(bool (*is)(const Format&), std::string_view last = " or ");
/// Returns the extensions of the formats that satisfy `is`: ".obj, .ply or .off".
std::string format_extensions(bool (*is)(const Format&), std::string_view last = " or ");
/// Returns the text for a mesh argument in the command-line help: "Mesh (OBJ, PLY, OFF, STL, glTF)".
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

/// Returns is(format) for the format of the file's extension, or false if the extension is unknown.
bool is_a(bool (*is)(const Format&), const std::filesystem::path& file);

}  // namespace viete::formats
