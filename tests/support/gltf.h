// glTF files for tests: a textured patch with a texture seam.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/encoding.h"

namespace viete::test {

using GltfJson = nlohmann::ordered_json;

/// The JSON document and the buffer of a glTF file.
struct GltfParts {
  GltfJson json;
  std::string bytes;

  template <class T>
  std::size_t view(const std::vector<T>& values) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    const std::size_t size = values.size() * sizeof(T);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
    bytes.append(reinterpret_cast<const char*>(values.data()), size);
    return json["bufferViews"].size() - 1;
  }

  template <class T>
  std::size_t accessor(const std::vector<T>& values, int component_type, const char* type,
                       std::size_t components) {
    const std::size_t bytes_of_it = view(values);  // adds a buffer view to the JSON
    json["accessors"].push_back({{"bufferView", bytes_of_it},
                                 {"componentType", component_type},
                                 {"count", values.size() / components},
                                 {"type", type}});
    return json["accessors"].size() - 1;
  }

  GltfJson& primitive() { return json["meshes"][0]["primitives"][0]; }

  std::string text() const {
    GltfJson embedded = json;
    embedded["buffers"] = {{{"byteLength", bytes.size()},
                            {"uri", "data:application/octet-stream;base64," + base::base64(bytes)}}};
    return embedded.dump();
  }

  std::string beside(const std::string& uri) const {
    GltfJson document = json;
    document["buffers"] = {{{"byteLength", bytes.size()}, {"uri", uri}}};
    return document.dump();
  }

  std::string glb() const {
    GltfJson document = json;
    document["buffers"][0] = {{"byteLength", bytes.size()}};
    std::string text = document.dump(), binary = bytes;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const auto word = [](std::size_t n) {
      const auto w = static_cast<std::uint32_t>(n);
      std::string four(4, '\0');
      std::memcpy(four.data(), &w, 4);
      return four;
    };
    return "glTF" + word(2) + word(28 + text.size() + binary.size()) + word(text.size()) + "JSON" + text +
           word(binary.size()) + std::string("BIN\0", 4) + binary;
  }
};

/// Returns the rectangle [0, 2] x [0, 1] in the plane z = 0: four triangles with a texture seam at x = 1. The
/// file has eight vertices at six places, a node at the origin, and a material with an embedded image.
inline GltfParts patch() {
  GltfParts p;
  p.json["asset"] = {{"version", "2.0"}, {"extras", {{"kept", "as it is"}}}};
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0,
                                        1, 0, 0, 2, 0, 0, 1, 1, 0, 2, 1, 0};
  const std::vector<float> texture = {0, 1, 1, 1, 0, 0, 1, 0, 0, 1, 1, 1, 0, 0, 1, 0};
  std::vector<float> normals;
  for (int i = 0; i < 8; ++i) normals.insert(normals.end(), {0, 0, 1});
  p.accessor(positions, 5126, "VEC3", 3);
  p.json["accessors"][0]["min"] = {0, 0, 0};
  p.json["accessors"][0]["max"] = {2, 1, 0};
  p.accessor(normals, 5126, "VEC3", 3);
  p.accessor(texture, 5126, "VEC2", 2);
  p.accessor(std::vector<std::uint16_t>{0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6}, 5123, "SCALAR", 1);
  const std::string image = "\x89PNG\r\n\x1a\nnot really one";
  p.json["images"] = {
      {{"bufferView", p.view(std::vector<char>(image.begin(), image.end()))}, {"mimeType", "image/png"}}};
  p.json["textures"] = {{{"source", 0}}};
  p.json["materials"] = {
      {{"name", "paint"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  p.json["meshes"] = {{{"name", "patch"},
                       {"primitives",
                        {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}},
                          {"indices", 3},
                          {"material", 0}}}}}};
  p.json["nodes"] = {{{"name", "only"}, {"mesh", 0}}};
  p.json["scenes"] = {{{"nodes", {0}}}};
  return p;
}

}  // namespace viete::test
