// The table of file formats: whoever asks what there is, or what a format can hold, asks here. A new one is
// its reader, its writer and its row.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "mesh/formats/read_result.h"
#include "mesh/formats/source.h"
#include "mesh/formats/text_writer.h"

namespace viete::mesh {

/// What a format takes of a surface beside positions and triangles.
namespace held {
enum What : unsigned {
  polygons = 1 << 0,
  points = 1 << 1,  ///< of a surface without faces
  texture_points = 1 << 2,
  colors = 1 << 3,
  polygon_colors = 1 << 4,
  normals = 1 << 5,         ///< one of each vertex at least,
  corner_normals = 1 << 6,  ///< and several
  objects = 1 << 7,         ///< and groups within them:
  groups = 1 << 8,
  materials = 1 << 9,
  textures = 1 << 10
};
}  // namespace held

struct Format {
  std::string_view extension;  ///< lower case, without the dot
  std::string_view name;       ///< in messages; one for all extensions of a format

  ReadResult (*read)(const Source&) = nullptr;  ///< of a surface; null: none is in it
  bool (*recognised)(const Source&) = nullptr;  ///< by its content; null: a name must tell
  void (*write)(const Content&, TextWriter&) = nullptr;

  bool may_be_binary = false;  ///< although its content is not recognised
  bool keeps_order = false;    ///< of vertices, which poses and keys go by
  bool holds_morphs = false;
  bool is_sequence = false;  ///< positions alone, frame after frame
  char up = 0;               ///< the axis that files of it agree on: 'y' or 'z'; 0: none
  bool in_metres = false;
  enum class Images { none, within, beside } images = Images::none;
  unsigned all_held = 0;  ///< of held::What

  constexpr bool holds(held::What what) const { return (all_held & what) != 0; }
};

/// In the order in which people are shown them.
std::span<const Format> all_formats();

/// Null if it is not in the table.
const Format* format_by_extension(std::string_view extension);
const Format* find_format(const std::filesystem::path& file);

/// Of a surface. Throws base::Error naming those that there are.
const Format& surface_format(const std::filesystem::path& file);

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
