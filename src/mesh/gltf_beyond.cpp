#include "mesh/gltf_beyond.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace viete::mesh {

namespace {

using BeyondJson = nlohmann::ordered_json;

// What is there need not be sound: only what the surface is made of was checked.
const BeyondJson& list_in(const BeyondJson& object, const char* key) {
  static const BeyondJson nothing = BeyondJson::array();
  const bool there = object.is_object() && object.contains(key) && object[key].is_array();
  return there ? object[key] : nothing;
}

template <class Is>
bool any_primitive(const BeyondJson& document, const Is& is) {
  for (const BeyondJson& mesh : list_in(document, "meshes")) {
    const BeyondJson& all = list_in(mesh, "primitives");
    if (std::any_of(all.begin(), all.end(), is)) return true;
  }
  return false;
}

bool has_attribute(const BeyondJson& primitive, const char* name) {
  return primitive.is_object() && primitive.contains("attributes") && primitive["attributes"].contains(name);
}

}  // namespace

std::vector<std::string> beyond_attributes(const GltfFile& file) {
  const BeyondJson document = BeyondJson::parse(file.json);
  std::vector<std::string> found;
  for (const char* key : {"animations", "skins", "cameras"}) {
    if (!list_in(document, key).empty()) found.emplace_back(key);
  }
  const auto add = [&](const char* what, const auto& is) {
    if (any_primitive(document, is)) found.emplace_back(what);
  };
  add("morph targets", [](const BeyondJson& p) { return !list_in(p, "targets").empty(); });
  add("tangents", [](const BeyondJson& p) { return has_attribute(p, "TANGENT"); });
  add("second texture coordinates", [](const BeyondJson& p) { return has_attribute(p, "TEXCOORD_1"); });
  add("points and lines", [](const BeyondJson& p) {
    return p.is_object() && p.contains("mode") && p["mode"].is_number_integer() && p["mode"] >= 0 &&
           p["mode"] < 4;
  });
  return found;
}

}  // namespace viete::mesh
