#include "mesh/formats/gltf_beyond.h"

#include <algorithm>

#include "mesh/formats/gltf_json.h"

namespace viete::mesh {

namespace {

template <class Is>
bool any_primitive(const GltfJson& document, const Is& is) {
  for (const GltfJson& mesh : list_of(document, "meshes")) {
    const GltfJson& all = list_of(mesh, "primitives");
    if (std::any_of(all.begin(), all.end(), is)) return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> beyond_attributes(const GltfFile& file) {
  const GltfJson& document = file.document;
  std::vector<std::string> found;
  for (const char* key : {"animations", "skins", "cameras"}) {
    if (!list_of(document, key).empty()) found.emplace_back(key);
  }
  const auto add = [&](const char* what, const auto& is) {
    if (any_primitive(document, is)) found.emplace_back(what);
  };
  add("morph targets", [](const GltfJson& p) { return !list_of(p, "targets").empty(); });
  add("tangents", [](const GltfJson& p) { return accessor_of(p, "TANGENT") >= 0; });
  add("second texture coordinates", [](const GltfJson& p) { return accessor_of(p, "TEXCOORD_1") >= 0; });
  add("points and lines", [](const GltfJson& p) {
    const auto mode = count_of(p, "mode");
    return mode && *mode < 4;
  });
  return found;
}

}  // namespace viete::mesh
