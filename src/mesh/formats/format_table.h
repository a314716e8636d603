// The table of file formats: whoever asks what there is, or what a format can hold, asks here. A new one is
// its reader, its writer and its row.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "mesh/formats/format.h"
#include "mesh/formats/original.h"

namespace viete::mesh {

/// In the order in which people are shown them.
std::span<const Format> all_formats();

/// Null if it is not in the table.
const Format* format_by_extension(std::string_view extension);
const Format* find_format(const std::filesystem::path& file);

/// Of a surface. Throws base::Error naming those that there are.
const Format& surface_format(const std::filesystem::path& file);

/// True if the original (or null) can write itself under this name.
bool writes_itself(const Original* original, const std::filesystem::path& file);

/// The format that the content certainly is of, whatever the file is called; null: no known one.
const Format* format_of_content(const std::filesystem::path& file, const Beginning& beginning);

/// The row of what a ReadResult says that a file is: "glTF binary".
const Format* format_of_description(std::string_view description);

/// "OBJ, PLY or OFF": the names of all that this is true of, each once.
std::string format_names(bool (*is)(const Format&), std::string_view last = " or ");
/// ".obj, .ply or .off"
std::string format_extensions(bool (*is)(const Format&), std::string_view last = " or ");
/// "Mesh (OBJ, PLY, OFF, STL, glTF)", in the help of commands.
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

/// The same of a file by its name; false for formats that are not known.
bool is_a(bool (*is)(const Format&), const std::filesystem::path& file);

}  // namespace viete::mesh
