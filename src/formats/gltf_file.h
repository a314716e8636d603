// A parsed glTF file: its JSON, buffers and images, and the places of its meshes in the scene.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/attributes.h"
#include "formats/source.h"
#include "mesh/surface.h"

namespace viete::formats {

using GltfJson = nlohmann::ordered_json;

/// The component types of the glTF specification.
enum GltfComponent {
  gltf_byte = 5120,
  gltf_unsigned_byte,
  gltf_short,
  gltf_unsigned_short,
  gltf_unsigned_int = 5125,
  gltf_float
};
enum GltfMode { gltf_points = 0, gltf_triangles = 4, gltf_strip, gltf_fan };
inline constexpr int gltf_array_buffer = 34962, gltf_element_buffer = 34963, gltf_clamp_to_edge = 33071;

/// Returns a member of an object. If the member is missing, returns a JSON null.
inline const GltfJson& member_of(const GltfJson& object, const char* key) {
  static const GltfJson nothing;
  if (!object.is_object()) return nothing;
  const auto found = object.find(key);
  return found == object.end() ? nothing : *found;
}

inline const GltfJson& list_of(const GltfJson& object, const char* key) {
  static const GltfJson no_list = GltfJson::array();
  const GltfJson& value = member_of(object, key);
  return value.is_array() ? value : no_list;
}

inline std::string text_of(const GltfJson& object, const char* key) {
  const GltfJson& value = member_of(object, key);
  return value.is_string() ? value.get<std::string>() : std::string();
}

/// Returns the value if it is a non-negative integer.
inline std::optional<std::uint64_t> count_of(const GltfJson& value) {
  const bool counts =
      value.is_number_unsigned() || (value.is_number_integer() && value.get<std::int64_t>() >= 0);
  return counts ? std::optional(value.get<std::uint64_t>()) : std::nullopt;
}

inline std::optional<std::uint64_t> count_of(const GltfJson& object, const char* key) {
  return count_of(member_of(object, key));
}

/// Returns a member that is an index, or -1 if the member is missing.
inline int index_of(const GltfJson& object, const char* key) {
  constexpr std::uint64_t largest = std::numeric_limits<int>::max();
  const auto count = count_of(object, key);
  return count ? static_cast<int>(std::min(*count, largest)) : -1;
}

inline int accessor_of(const GltfJson& primitive, const char* attribute) {
  return index_of(member_of(primitive, "attributes"), attribute);
}

/// Returns document[list][index], or a JSON null if the element is missing.
inline const GltfJson& element_of(const GltfJson& document, const char* list, int index) {
  static const GltfJson nothing;
  const GltfJson& all = list_of(document, list);
  return index >= 0 && static_cast<std::size_t>(index) < all.size() ? all[static_cast<std::size_t>(index)]
                                                                    : nothing;
}

/// Returns true if the file has an animation of weights of morph targets or, without `weights`, another one.
bool has_animation(const GltfJson& document, bool weights);

struct GltfBuffer {
  /// The place of the bytes: the binary chunk of a GLB, base64 in the JSON, or an external file.
  enum class Home { chunk, text, beside };
  Home home = Home::chunk;
  std::filesystem::path path;  ///< path of an external file; otherwise empty
  std::string bytes;           ///< its size is the byteLength in the JSON
};

struct GltfImage {
  ImageFile file;
  std::string uri;  ///< URI of an external file, as written in the JSON; otherwise empty
};

struct GltfFile {
  std::string name;  ///< for messages
  bool binary = false;
  GltfJson document;  ///< checked by take_apart(), without the data of embedded buffers
  std::vector<GltfBuffer> buffers;
  std::vector<GltfImage> images;
  std::vector<std::string> warnings;  ///< one line each, without the name of the file
  std::string other_chunks;           ///< unknown chunks of a GLB with their headers
  /// True if a texture was not read, because its coordinates differ from the coordinates of the base colour.
  bool has_other_coordinates = false;
};

/// True for extensions that compress meshes or buffer views.
bool compresses_gltf(std::string_view extension);

/// Parses glTF 2.0, JSON or GLB. External buffers must be in the file's folder or below. External images are
/// not opened. If data of the surface is missing or invalid, throws base::Error. If it is compressed, throws
/// CompressedGltf, unless `may_be_compressed`; then buffers can be empty, because only other programs need
/// them.
GltfFile take_apart(const Source& source, bool may_be_compressed = false);

/// Maps a point x to M * x + offset. `columns` are the columns of the matrix M.
struct AffineMap {
  std::array<mesh::Vec3, 3> columns{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  mesh::Vec3 offset{0, 0, 0};

  bool is_identity() const { return *this == AffineMap{}; }
  double determinant() const { return dot(columns[0], mesh::cross(columns[1], columns[2])); }
  mesh::Vec3 of_vector(const mesh::Vec3& v) const {
    return v[0] * columns[0] + v[1] * columns[1] + v[2] * columns[2];
  }
  mesh::Vec3 of_point(const mesh::Point& p) const { return of_vector(p) + offset; }
  /// Maps a plane's normal by the matrix of cofactors. Even if the map is a mirror, the normal stays on the
  /// same side of the plane. The result can have any length.
  mesh::Vec3 of_normal(const mesh::Vec3& n) const;
  /// Returns nullopt if the map is singular.
  std::optional<AffineMap> inverse() const;

  friend AffineMap operator*(const AffineMap& a, const AffineMap& b);
  friend bool operator==(const AffineMap&, const AffineMap&) = default;
};

/// A mesh placed by one node.
struct GltfPlacement {
  int node = 0, mesh = 0;
  AffineMap map;  ///< from mesh coordinates to scene coordinates
};

/// Returns the placements in the default scene; without a default, in the first scene; without scenes, of all
/// nodes. Parents come first. If the nodes do not form trees or an index is invalid, throws base::Error.
std::vector<GltfPlacement> placements_of(const GltfFile& file);

/// The accessors of a morph target's offsets. -1 means missing.
struct GltfTarget {
  int positions = -1, normals = -1, tangents = -1;
};

/// Consecutive vertices of the file that one or more primitives of a placement use.
struct GltfPiece {
  std::size_t placement = 0, first = 0, count = 0;
  int positions = -1, normals = -1, tangents = -1;         ///< accessors; -1 means missing
  std::shared_ptr<const std::vector<GltfTarget>> targets;  ///< targets of the first primitive of the piece
};

struct GltfMap {
  std::vector<GltfPlacement> placements;
  std::vector<GltfPiece> pieces;              ///< sorted by `first`
  std::vector<std::uint32_t> surface_vertex;  ///< for each vertex of the file, a vertex of the surface
  std::vector<std::uint32_t> corner_vertex;   ///< for each entry of Surface::corners, a vertex of the file
};

}  // namespace viete::formats
