// The table of file formats and their capabilities. A new format needs a reader, a writer and a row here.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "formats/format.h"
#include "formats/original.h"

namespace viete::formats {

/// In display order.
std::span<const Format> all_formats();

/// Null if the format is unknown.
const Format* format_by_extension(std::string_view extension);
const Format* find_format(const std::filesystem::path& file);

/// The format of a surface file. Throws base::Error that lists the known formats.
const Format& surface_format(const std::filesystem::path& file);

/// True if the original (may be null) can be written again under this name.
bool writes_itself(const Original* original, const std::filesystem::path& file);

/// The format that the content proves, regardless of the extension; null if unknown.
const Format* format_of_content(const std::filesystem::path& file, const Beginning& beginning);

/// The row for a ReadResult::format such as "glTF binary".
const Format* format_of_description(std::string_view description);

/// Names of the formats that satisfy `is`, each once: "OBJ, PLY or OFF".
std::string format_names(bool (*is)(const Format&), std::string_view last = " or ");
/// The same with extensions: ".obj, .ply or .off".
std::string format_extensions(bool (*is)(const Format&), std::string_view last = " or ");
/// For command-line help: "Mesh (OBJ, PLY, OFF, STL, glTF)".
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

/// Applies `is` to the format of the file's extension; false for unknown formats.
bool is_a(bool (*is)(const Format&), const std::filesystem::path& file);

}  // namespace viete::formats
