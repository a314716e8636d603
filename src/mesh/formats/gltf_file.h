// A glTF file taken apart: its JSON, and the bytes that this leads to.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/formats/attributes.h"
#include "mesh/formats/source.h"

namespace viete::mesh {

using GltfJson = nlohmann::ordered_json;

/// Numbers that stand for words, as the specification has them. Integers of indices are unsigned.
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

/// Null where there is none.
inline const GltfJson& member_of(const GltfJson& object, const char* key) {
  static const GltfJson nothing;
  if (!object.is_object()) return nothing;
  const auto found = object.find(key);
  return found == object.end() ? nothing : *found;
}

/// Empty where there is none.
inline const GltfJson& list_of(const GltfJson& object, const char* key) {
  static const GltfJson no_list = GltfJson::array();
  const GltfJson& value = member_of(object, key);
  return value.is_array() ? value : no_list;
}

inline std::string text_of(const GltfJson& object, const char* key) {
  const GltfJson& value = member_of(object, key);
  return value.is_string() ? value.get<std::string>() : std::string();
}

/// A whole number that is not negative.
inline std::optional<std::uint64_t> count_of(const GltfJson& value) {
  const bool counts =
      value.is_number_unsigned() || (value.is_number_integer() && value.get<std::int64_t>() >= 0);
  return counts ? std::optional(value.get<std::uint64_t>()) : std::nullopt;
}

inline std::optional<std::uint64_t> count_of(const GltfJson& object, const char* key) {
  return count_of(member_of(object, key));
}

/// The number of something in a list of the file; -1 where there is none.
inline int index_of(const GltfJson& object, const char* key) {
  constexpr std::uint64_t largest = std::numeric_limits<int>::max();
  const auto count = count_of(object, key);
  return count ? static_cast<int>(std::min(*count, largest)) : -1;
}

/// The accessor of a primitive's attribute; -1 where it has none.
inline int accessor_of(const GltfJson& primitive, const char* attribute) {
  return index_of(member_of(primitive, "attributes"), attribute);
}

/// Null where there is none.
inline const GltfJson& element_of(const GltfJson& document, const char* list, int index) {
  static const GltfJson nothing;
  const GltfJson& all = list_of(document, list);
  return index >= 0 && static_cast<std::size_t>(index) < all.size() ? all[static_cast<std::size_t>(index)]
                                                                    : nothing;
}

struct GltfBuffer {
  enum class Home { chunk, text, beside };  ///< the GLB's binary chunk; base64 in the JSON; a file beside
  Home home = Home::chunk;
  std::filesystem::path path;  ///< of the file beside
  std::string bytes;           ///< as many as the JSON says there are
};

/// Where an image of the JSON leads.
struct GltfImage {
  ImageFile file;   ///< its name is empty where the JSON gives none
  std::string uri;  ///< of a file beside, as it is written; otherwise empty
};

struct GltfFile {
  std::string name;  ///< how messages call it
  bool binary = false;
  GltfJson document;  ///< checked, see take_apart(); without the bytes of buffers that lie in it
  std::vector<GltfBuffer> buffers;
  std::vector<GltfImage> images;
  std::vector<std::string> warnings;  ///< one line each
  std::string other_chunks;           ///< of a GLB: those of kinds that are not known here, with their heads
};

/// glTF 2.0, as text or as GLB. Buffers beside are read within its folder only, images are not opened. Throws
/// base::Error if anything that the surface needs is missing, compressed, or not as it claims to be.
GltfFile take_apart(const Source& source);

/// "a b" is "a%20b", as paths of files beside are written.
std::string encoded_uri(std::string_view path);

}  // namespace viete::mesh
