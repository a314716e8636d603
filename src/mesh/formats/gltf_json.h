// The JSON of glTF files: its members, whatever stands in their place.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

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

}  // namespace viete::mesh
