// The JSON of glTF files: its members, whatever stands in their place.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace viete::mesh {

using GltfJson = nlohmann::ordered_json;

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

}  // namespace viete::mesh
