// Reads glTF files with another library, to check files that Viete has written.
#pragma once

#include <doctest/doctest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace viete::test {

class GltfJudge {
public:
  explicit GltfJudge(const std::filesystem::path& path) {
    tinygltf::TinyGLTF loader;
    std::string problem, warning;
    loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int,
                             const unsigned char*, int, void*) { return true; },
                          nullptr);
    const bool good = path.extension() == ".glb"
                          ? loader.LoadBinaryFromFile(&model, &problem, &warning, path.string())
                          : loader.LoadASCIIFromFile(&model, &problem, &warning, path.string());
    REQUIRE_MESSAGE(good, problem);
    CHECK(warning == "");
  }

  template <class T>
  std::vector<T> view(int number, std::size_t offset, std::size_t count) const {
    const auto& v = model.bufferViews.at(static_cast<std::size_t>(number));
    const auto& bytes = model.buffers.at(static_cast<std::size_t>(v.buffer)).data;
    REQUIRE(offset + count * sizeof(T) <= v.byteLength);
    std::vector<T> values(count);
    std::memcpy(values.data(), bytes.data() + v.byteOffset + offset, count * sizeof(T));
    return values;
  }

  std::vector<float> floats(int accessor) const {
    const auto& a = model.accessors.at(static_cast<std::size_t>(accessor));
    const auto parts =
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type)));
    std::vector<float> all(a.count * parts, 0.0F);
    if (a.componentType == TINYGLTF_COMPONENT_TYPE_SHORT) {
      const auto shorts = view<std::int16_t>(a.bufferView, a.byteOffset, all.size());
      std::ranges::transform(shorts, all.begin(), [](auto x) { return static_cast<float>(x) / 32767; });
      return all;
    }
    REQUIRE(a.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT);
    if (a.bufferView >= 0) all = view<float>(a.bufferView, a.byteOffset, all.size());
    if (!a.sparse.isSparse) return all;
    const auto count = static_cast<std::size_t>(a.sparse.count);
    const auto values = view<float>(a.sparse.values.bufferView, 0, count * parts);
    std::vector<std::uint32_t> where;
    if (a.sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) {
      for (const auto i : view<std::uint16_t>(a.sparse.indices.bufferView, 0, count)) where.push_back(i);
    } else {
      where = view<std::uint32_t>(a.sparse.indices.bufferView, 0, count);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) CHECK(where[i] > where[i - 1]);
      for (std::size_t k = 0; k < parts; ++k) all.at(where[i] * parts + k) = values[i * parts + k];
    }
    return all;
  }

  tinygltf::Model model;
};

}  // namespace viete::test
