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
  normals = 1 << 5,         ///< one normal per vertex
  corner_normals = 1 << 6,  ///< several normals per vertex
  both_colors = 1 << 7,     ///< colors and polygon_colors in one file
  splats = 1 << 8,          ///< Gaussian splats
  objects = 1 << 9,         ///< names of objects
  groups = 1 << 10,         ///< names of groups
  textures = 1 << 11,       ///< images of the base colour
  materials = 1 << 12,      ///< all properties of Material, with images
};
}  // namespace held

struct Format {
  std::string_view extension;  ///< lower case, without the dot
  std::string_view name;       ///< for messages; the same in all entries of a format

  ReadResult (*read)(const Source&) = nullptr;  ///< reads a surface; null for point caches
  bool (*recognised)(const Source&) = nullptr;  ///< detects the format by content; may be null
  /// A stricter test than `recognised`, used before a file is overwritten.
  bool (*is_certain)(const Beginning&) = nullptr;
  void (*write)(const Content&, TextWriter&) = nullptr;
  /// Writes the materials to a library: another file with this extension.
  void (*write_library)(const Attributes&, TextWriter&) = nullptr;
  std::string_view library_extension = {};

  bool may_be_binary = false;  ///< true if read() accepts binary content that recognised() rejects
  bool keeps_order = false;    ///< true if files keep the vertex order; poses and keys need this order
  bool holds_morphs = false;
  bool embeds_images = false;
  bool is_sequence = false;  ///< true for a point cache: positions of several frames
  char up = 0;               ///< the usual up axis, 'y' or 'z'; 0 if there is no convention
  bool in_metres = false;
  unsigned all_held = 0;  ///< a combination of held::What

  constexpr bool holds(held::What what) const { return (all_held & what) != 0; }
  constexpr bool stores_only_splats() const { return all_held == held::splats; }
};

/// All formats, in the order of menus and messages.
std::span<const Format> all_formats();

/// The next two functions return null if the extension is unknown.
const Format* format_by_extension(std::string_view extension);
const Format* find_format(const std::filesystem::path& file);

/// Returns the format for a surface file's extension. For other extensions, throws base::Error.
const Format& surface_format(const std::filesystem::path& file);

/// Returns true if `original` can be rewritten to a file with this extension. `original` may be null.
bool writes_itself(const Original* original, const std::filesystem::path& file);

/// Detects the format only by content: by Format::is_certain, or as a point cache. Returns null if unknown.
const Format* format_of_content(const std::filesystem::path& file, const Beginning& beginning);

/// Returns the surface format for a ReadResult::format such as "glTF binary", or null if unknown.
const Format* format_of_description(std::string_view description);

/// Returns the names of the formats that satisfy `is`: "OBJ, PLY or OFF". `last` precedes the last name.
std::string format_names(bool (*is)(const Format&), std::string_view last = " or ");
/// Returns the extensions of the formats that satisfy `is`: ".obj, .ply or .off".
std::string format_extensions(bool (*is)(const Format&), std::string_view last = " or ");

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
/// Returns is(format) for a ReadResult::format, or false if the format is unknown.
bool describes(bool (*is)(const Format&), std::string_view description);

}  // namespace viete::formats
