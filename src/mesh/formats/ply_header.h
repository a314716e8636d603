// The header of a PLY file: which elements with which properties follow, and how they are stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesh/formats/source.h"
#include "mesh/formats/surface_builder.h"
#include "mesh/formats/text_cursor.h"

namespace viete::mesh {

enum class PlyType : std::uint8_t {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64
};

/// Bytes of one value in a binary file.
std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;   ///< of the value, or of each item of a list
  std::optional<PlyType> list_size;  ///< the type of the list's length; empty for a single value
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  /// Index of the first property with one of these names, properties.size() if there is none.
  std::size_t find(const std::string& name, const std::string& other = "") const;
};

struct PlyHeader {
  enum class Format { ascii, little_endian, big_endian };

  Format format = Format::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> texture_files;  ///< of `comment TextureFile`, as MeshLab writes them
  std::size_t unknown_lines = 0;           ///< that were passed over

  const PlyElement* find(const std::string& name) const;
};

/// Leaves the cursor behind the header. Comments go to the builder; lines that start with no word of a header
/// are passed over, with a warning. Throws base::Error also when the elements
/// announced cannot fit into what is left of the file.
PlyHeader read_ply_header(TextCursor& text, const Source& source, SurfaceBuilder& builder);

}  // namespace viete::mesh
