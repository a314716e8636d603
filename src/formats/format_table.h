// The table of file formats and their capabilities. To add a format, add a reader, a writer and a row.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "formats/original.h"
#include "formats/source.h"
#include "formats/text_writer.h"

namespace viete::formats {

/// Content that a format can store besides positions and triangles.
namespace held {
enum What : unsigned {
  polygons = 1 << 0,
  points = 1 << 1,  ///< surfaces without faces
  texture_points = 1 << 2,
  colors = 1 << 3,
  polygon_colors = 1 << 4,
  normals = 1 << 5,        ///< one normal per vertex
  corner_normals = 1 << 6  ///< several normals per vertex
};
}  // namespace held

struct Format {
  std::string_view extension;  ///< lower case, without the dot
  std::string_view name;       ///< for messages; the same for all extensions of the format

  ReadResult (*read)(const Source&) = nullptr;  ///< reads a surface; null for point caches
  bool (*recognised)(const Source&) = nullptr;  ///< detects the format by content; null: only by extension
  /// A stricter test before a file is overwritten. False for other content with a similar beginning.
  bool (*is_certain)(const Beginning&) = nullptr;
  void (*write)(const Content&, TextWriter&) = nullptr;

  bool may_be_binary = false;  ///< read() accepts binary content that recognised() rejects
  bool keeps_order = false;    ///< keeps the vertex order, on which poses and keys depend
  bool holds_morphs = false;
  bool is_sequence = false;  ///< a point cache: positions of several frames
  char up = 0;               ///< the usual up axis, 'y' or 'z'; 0: no convention
  bool in_metres = false;
  unsigned all_held = 0;  ///< a combination of held::What

  constexpr bool holds(held::What what) const { return (all_held & what) != 0; }
};

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
