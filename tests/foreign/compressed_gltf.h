// Compresses glTF files of tests with the encoders of Draco and meshoptimizer.
#pragma once

#include <doctest/doctest.h>
#include <draco/compression/expert_encode.h>
#include <meshoptimizer.h>

#include <memory>

#include "formats/gltf_accessors.h"
#include "support/gltf.h"

namespace viete::test {

using formats::GltfJson;

/// Returns a grid of n x n vertices with a wave. Its texture points are unique. The attributes have several
/// types and strides. It has a material with an image, and a morph target.
inline GltfParts grid(std::uint16_t n) {
  GltfParts p = patch();
  std::vector<float> positions, normals, texture, target, weights;
  std::vector<std::uint16_t> colors, triangles;
  std::vector<std::uint8_t> joints;
  for (std::uint16_t y = 0; y < n; ++y)
    for (std::uint16_t x = 0; x < n; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(n),
                  v = static_cast<float>(y) / static_cast<float>(n);
      positions.insert(positions.end(), {3 * u, 2 * v, 0.3F * u * u - 0.7F * u * v});
      normals.insert(normals.end(), {0, 0, 1});
      texture.insert(texture.end(), {u, v});
      target.insert(target.end(), {0, 0, u + v});
      weights.insert(weights.end(), {u, 1 - u, 0, 0});
      colors.insert(colors.end(),
                    {static_cast<std::uint16_t>(100 * x), static_cast<std::uint16_t>(100 * y), 7, 0});
      joints.insert(joints.end(), {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y), 0, 1});
      if (x == 0 || y == 0) continue;
      const auto at = [&](int back, int up) { return static_cast<std::uint16_t>((y - up) * n + x - back); };
      triangles.insert(triangles.end(), {at(1, 1), at(0, 1), at(0, 0), at(1, 1), at(0, 0), at(1, 0)});
    }
  const GltfJson image = p.json["images"][0];
  const std::string image_bytes = p.bytes.substr(p.json["bufferViews"].back()["byteOffset"]);
  p.bytes.clear();
  p.json["bufferViews"] = p.json["accessors"] = GltfJson::array();
  const std::size_t first = p.accessor(positions, 5126, "VEC3", 3);
  p.json["accessors"][first]["min"] = {0, 0, -1};
  p.json["accessors"][first]["max"] = {3, 2, 1};
  GltfJson attributes{{"POSITION", first}, {"NORMAL", p.accessor(normals, 5126, "VEC3", 3)}};
  attributes["TEXCOORD_0"] = p.accessor(texture, 5126, "VEC2", 2);
  attributes["COLOR_0"] = p.accessor(colors, 5123, "VEC3", 4);
  p.json["bufferViews"].back()["byteStride"] = 8;
  p.json["accessors"].back()["normalized"] = true;
  attributes["JOINTS_0"] = p.accessor(joints, 5121, "VEC4", 4);
  attributes["WEIGHTS_0"] = p.accessor(weights, 5126, "VEC4", 4);
  GltfJson& primitive = p.primitive();
  primitive["attributes"] = attributes;
  primitive["indices"] = p.accessor(triangles, 5123, "SCALAR", 1);
  primitive["targets"] = {{{"POSITION", p.accessor(target, 5126, "VEC3", 3)}}};
  p.json["images"][0]["bufferView"] = p.view(std::vector<char>(image_bytes.begin(), image_bytes.end()));
  return p;
}

/// The file as read from a GLB, with its accessors.
struct TakenGltf {
  explicit TakenGltf(const std::string& glb) : file(formats::take_apart({"given.glb", "glb", glb})) {}
  formats::GltfFile file;
  formats::GltfAccessors accessors{file};
};

/// Encodes a primitive. Attribute k has the unique number 10 + k; `ids` becomes the map of the extension.
inline std::string draco_bytes(const TakenGltf& from, const GltfJson& primitive, bool sequential, int bits,
                               GltfJson& ids) {
  draco::Mesh mesh;
  const auto count = static_cast<std::uint32_t>(from.accessors.count(primitive["attributes"]["POSITION"]));
  mesh.set_num_points(count);
  const auto corners = from.accessors.indices(primitive["indices"], count);
  for (std::size_t c = 0; c < corners.size(); c += 3)
    mesh.AddFace({draco::PointIndex(corners[c]), draco::PointIndex(corners[c + 1]),
                  draco::PointIndex(corners[c + 2])});
  for (const auto& [name, accessor] : primitive["attributes"].items()) {
    const formats::GltfPlace place = from.accessors.place(accessor);
    const GltfJson& json = from.file.document["accessors"][accessor.get<std::size_t>()];
    const int component = json["componentType"];
    const auto components = static_cast<std::int8_t>(from.accessors.components(accessor));
    const auto kind =
        name == "POSITION" ? draco::GeometryAttribute::POSITION : draco::GeometryAttribute::GENERIC;
    draco::GeometryAttribute attribute;
    attribute.Init(kind, nullptr, static_cast<std::uint8_t>(components),
                   component == 5126   ? draco::DT_FLOAT32
                   : component == 5123 ? draco::DT_UINT16
                                       : draco::DT_UINT8,
                   json.contains("normalized"), static_cast<std::int64_t>(place.size), 0);
    const int id = mesh.AddAttribute(attribute, true, count);
    for (std::uint32_t i = 0; i < count; ++i)
      mesh.attribute(id)->SetAttributeValue(
          draco::AttributeValueIndex(i), from.file.buffers[0].bytes.data() + place.offset + i * place.stride);
    mesh.attribute(id)->set_unique_id(10 + static_cast<std::uint32_t>(id));
    ids[name] = 10 + id;
  }
  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(sequential ? draco::MESH_SEQUENTIAL_ENCODING : draco::MESH_EDGEBREAKER_ENCODING);
  if (bits > 0) encoder.SetAttributeQuantization(0, bits);
  draco::EncoderBuffer buffer;
  REQUIRE(encoder.EncodeToBuffer(&buffer).ok());
  return {buffer.data(), buffer.size()};
}

/// Returns the parts with each primitive encoded by Draco. `bits` quantize positions; 0 keeps the floats.
inline GltfParts with_draco(const GltfParts& plain, bool sequential, int bits) {
  const std::string glb = plain.glb();
  const TakenGltf from(glb);
  GltfParts packed;
  packed.json = plain.json;
  packed.json["bufferViews"] = GltfJson::array();
  packed.json["extensionsUsed"] = packed.json["extensionsRequired"] =
      GltfJson::array({"KHR_draco_mesh_compression"});
  const auto keep = [&](GltfJson& holder) {
    const GltfJson& view = plain.json["bufferViews"][holder["bufferView"].get<std::size_t>()];
    const std::string bytes = plain.bytes.substr(view["byteOffset"], view["byteLength"]);
    holder["bufferView"] = packed.view(std::vector<char>(bytes.begin(), bytes.end()));
  };
  keep(packed.json["images"][0]);
  for (GltfJson& mesh : packed.json["meshes"])
    for (GltfJson& primitive : mesh["primitives"]) {
      GltfJson ids;
      const std::string bytes = draco_bytes(from, primitive, sequential, bits, ids);
      const std::size_t view = packed.view(std::vector<char>(bytes.begin(), bytes.end()));
      primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view}, {"attributes", ids}};
      for (const auto& [name, accessor] : primitive["attributes"].items())
        packed.json["accessors"][accessor.get<std::size_t>()].erase("bufferView");
      packed.json["accessors"][primitive["indices"].get<std::size_t>()].erase("bufferView");
      for (const GltfJson& target : formats::list_of(primitive, "targets"))
        keep(packed.json["accessors"][target["POSITION"].get<std::size_t>()]);
    }
  return packed;
}

/// Returns the compressed bytes and the members of the extension for elements of `stride` bytes.
inline std::pair<std::string, GltfJson> meshopt_bytes(const std::string& bytes, std::size_t stride,
                                                      const std::string& mode) {
  const std::size_t count = bytes.size() / stride;
  std::string out(2 * bytes.size() + 1000, '\0');
  auto* const to = reinterpret_cast<unsigned char*>(out.data());
  std::vector<unsigned> indices(count);
  meshopt_encodeVertexVersion(0);  // later versions are not part of the extension
  for (std::size_t i = 0; i < count && mode != "ATTRIBUTES"; ++i)
    std::memcpy(&indices[i], &bytes[i * stride], stride);
  out.resize(mode == "ATTRIBUTES"  ? meshopt_encodeVertexBuffer(to, out.size(), bytes.data(), count, stride)
             : mode == "TRIANGLES" ? meshopt_encodeIndexBuffer(to, out.size(), indices.data(), count)
                                   : meshopt_encodeIndexSequence(to, out.size(), indices.data(), count));
  REQUIRE(!out.empty());
  return {
      out,
      {{"buffer", 0}, {"byteLength", out.size()}, {"byteStride", stride}, {"mode", mode}, {"count", count}}};
}

/// Returns the parts with all views compressed by meshoptimizer, except those of images. The views refer to a
/// fallback buffer without data.
inline GltfParts with_meshopt(const GltfParts& plain, const std::string& mode_of_indices,
                              const std::string& name = "EXT_meshopt_compression") {
  GltfParts packed;
  packed.json = plain.json;
  packed.json["extensionsUsed"] = packed.json["extensionsRequired"] = GltfJson::array({name});
  std::size_t fallback = 0;
  for (std::size_t i = 0; i < packed.json["bufferViews"].size(); ++i) {
    GltfJson& view = packed.json["bufferViews"][i];
    std::string bytes = plain.bytes.substr(view["byteOffset"], view["byteLength"]);
    GltfJson members;
    std::size_t stride = view.value("byteStride", 0);
    for (const GltfJson& accessor : plain.json["accessors"])
      if (accessor["bufferView"] == i && stride == 0)
        stride = bytes.size() / accessor["count"].get<std::size_t>();
    if (stride > 0)
      std::tie(bytes, members) = meshopt_bytes(bytes, stride, stride == 2 ? mode_of_indices : "ATTRIBUTES");
    packed.bytes.resize((packed.bytes.size() + 3) / 4 * 4);
    (stride > 0 ? members : view)["byteOffset"] = packed.bytes.size();
    packed.bytes += bytes;
    if (stride == 0) continue;
    view["buffer"] = 1;
    view["byteOffset"] = fallback;
    fallback += view["byteLength"].get<std::size_t>();
    view["extensions"][name] = members;
  }
  packed.json["buffers"] = {nullptr, {{"byteLength", fallback}}};
  packed.json["buffers"][1]["extensions"][name]["fallback"] = true;
  return packed;
}

}  // namespace viete::test
