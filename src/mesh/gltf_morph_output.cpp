#include "mesh/gltf_morph_output.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "base/error.h"

namespace viete::mesh {

namespace {

constexpr int gltf_short = 5123, gltf_int = 5125, gltf_float = 5126;  // unsigned ones

// Zeros for as many more targets as there are now.
void widen_list(GltfJson& of, std::size_t count) {
  GltfJson& weights = of["weights"];
  if (!weights.is_array()) weights = GltfJson::array();
  while (weights.size() < count) weights.push_back(0);
}

}  // namespace

GltfJson& GltfMorphs::mesh_of(std::size_t node) const {
  return document_["meshes"][document_["nodes"][node]["mesh"].get<std::size_t>()];
}

std::size_t GltfMorphs::targets_before(std::size_t node) const {
  std::size_t count = 0;
  for (const GltfJson& primitive : list_of(mesh_of(node), "primitives"))
    count = std::max(count, list_of(primitive, "targets").size());
  return count;
}

void GltfMorphs::add_target(const MorphedVertices& vertices, std::span<const double> positions,
                            std::span<const double> normals, std::span<const double> tangents) {
  GltfJson target = {{"POSITION", add_deltas(vertices.positions, positions)}};
  if (!normals.empty()) target["NORMAL"] = add_deltas(vertices.normals, normals);
  if (!tangents.empty()) target["TANGENT"] = add_deltas(vertices.tangents, tangents);
  GltfJson& primitives = mesh_of(vertices.node)["primitives"];
  for (const std::size_t i : vertices.primitives) primitives[i]["targets"].push_back(target);
}

std::size_t GltfMorphs::add_view(const void* data, std::size_t size) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
  document_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}});
  bytes_.append(static_cast<const char*>(data), size);
  return document_["bufferViews"].size() - 1;
}

// Where few vertices move, these alone: the others have zeros.
std::size_t GltfMorphs::add_deltas(std::span<const float> base, std::span<const double> now) {
  std::vector<float> deltas(base.size()), some;
  std::vector<std::uint32_t> moved;
  float low[3], high[3];
  std::fill_n(low, 3, std::numeric_limits<float>::max());
  std::fill_n(high, 3, -low[0]);
  for (std::size_t i = 0; i < deltas.size(); ++i) {
    deltas[i] = static_cast<float>(now[i] - static_cast<double>(base[i]));
    if (!std::isfinite(deltas[i]))
      throw base::Error("vertex " + std::to_string(i / 3),
                        "its position does not fit into the floats of glTF",
                        "write another format, or scale the model");
    low[i % 3] = std::min(low[i % 3], deltas[i]);
    high[i % 3] = std::max(high[i % 3], deltas[i]);
    if (i % 3 != 2 || (deltas[i] == 0 && deltas[i - 1] == 0 && deltas[i - 2] == 0)) continue;
    moved.push_back(static_cast<std::uint32_t>(i / 3));
    some.insert(some.end(), {deltas[i - 2], deltas[i - 1], deltas[i]});
  }
  if (moved.empty()) moved.push_back(0), some.assign(3, 0);  // a sparse accessor has one value at least
  const std::size_t count = deltas.size() / 3;
  const bool is_short = count <= std::size_t{1} << 16;
  GltfJson accessor = {{"componentType", gltf_float}, {"count", count}, {"type", "VEC3"}};
  if (moved.size() * (is_short ? 14 : 16) < 12 * count) {
    const std::vector<std::uint16_t> shorts(is_short ? moved.begin() : moved.end(), moved.end());
    const std::size_t where =
        is_short ? add_view(shorts.data(), 2 * shorts.size()) : add_view(moved.data(), 4 * moved.size());
    const std::size_t what = add_view(some.data(), 4 * some.size());
    accessor["sparse"] = {
        {"count", moved.size()},
        {"indices", {{"bufferView", where}, {"componentType", is_short ? gltf_short : gltf_int}}},
        {"values", {{"bufferView", what}}}};
  } else {
    accessor["bufferView"] = add_view(deltas.data(), 4 * deltas.size());
  }
  accessor["min"] = std::vector<float>(low, low + 3);
  accessor["max"] = std::vector<float>(high, high + 3);
  document_["accessors"].push_back(std::move(accessor));
  return document_["accessors"].size() - 1;
}

std::size_t GltfMorphs::add_numbers(std::span<const float> values, bool with_bounds) {
  GltfJson accessor = {{"bufferView", add_view(values.data(), values.size_bytes())},
                       {"componentType", gltf_float},
                       {"count", values.size()},
                       {"type", "SCALAR"}};
  if (with_bounds) {
    accessor["min"] = {values.front()};
    accessor["max"] = {values.back()};
  }
  document_["accessors"].push_back(std::move(accessor));
  return document_["accessors"].size() - 1;
}

std::vector<GltfMorphs::Output> GltfMorphs::weights_of(std::size_t node) const {
  std::vector<Output> found;
  const GltfJson& animations = list_of(document_, "animations");
  for (std::size_t a = 0; a < animations.size(); ++a) {
    const GltfJson &channels = list_of(animations[a], "channels"),
                   &samplers = list_of(animations[a], "samplers");
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const GltfJson& target = member_of(channels[c], "target");
      const auto sampler = count_of(channels[c], "sampler");
      if (text_of(target, "path") != "weights" || count_of(target, "node") != node || !sampler ||
          *sampler >= samplers.size())
        continue;
      const auto output = count_of(samplers[*sampler], "output");
      if (output && *output < list_of(document_, "accessors").size())
        found.push_back({a, c, static_cast<int>(*output)});
    }
  }
  return found;
}

// Its sampler may be that of another node too, which stays as it is.
void GltfMorphs::widen(const Output& output, std::span<const double> numbers, std::size_t before,
                       std::size_t added) {
  if (before == 0 || numbers.size() % before != 0) return;
  std::vector<float> wide;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    wide.push_back(static_cast<float>(numbers[i]));
    if (i % before == before - 1) wide.insert(wide.end(), added, 0.0F);
  }
  const std::size_t accessor = add_numbers(wide, false);
  GltfJson& animation = document_["animations"][output.animation];
  GltfJson& channel = animation["channels"][output.channel];
  GltfJson sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
  sampler["output"] = accessor;
  channel["sampler"] = animation["samplers"].size();
  animation["samplers"].push_back(std::move(sampler));
}

void GltfMorphs::name_targets(const MorphAnimation& animation, const MorphTargets& targets, std::size_t node,
                              std::size_t before) {
  GltfJson& mesh = mesh_of(node);
  widen_list(mesh, before + targets.keys.size());
  GltfJson& placed = document_["nodes"][node];
  if (placed.contains("weights")) widen_list(placed, before + targets.keys.size());
  GltfJson& extras = mesh["extras"];
  if (extras.is_null()) extras = GltfJson::object();
  if (!extras.is_object()) return;  // somebody's own
  GltfJson& names = extras["targetNames"];
  if (!names.is_array()) names = GltfJson::array();
  while (names.size() < before) names.push_back("target " + std::to_string(names.size() + 1));
  for (const std::size_t key : targets.keys) {
    const std::string& name = animation.keys[key].name;
    names.push_back(name.empty() ? "target " + std::to_string(names.size() + 1) : name);
  }
}

void GltfMorphs::animate(const MorphAnimation& animation, const MorphTargets& targets,
                         std::span<const std::size_t> nodes, std::span<const std::size_t> before) {
  if (nodes.empty()) return;
  std::vector<float> times;
  for (const MorphKey& key : animation.keys) times.push_back(static_cast<float>(key.seconds));
  const std::size_t input = add_numbers(times, true), count = targets.keys.size();
  GltfJson made = {
      {"name", animation.name}, {"channels", GltfJson::array()}, {"samplers", GltfJson::array()}};
  std::map<std::size_t, std::size_t> samplers;  // by the number of targets before ours
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto [at, added] = samplers.try_emplace(before[i], made["samplers"].size());
    if (added) {
      std::vector<float> weights(times.size() * (before[i] + count), 0.0F);
      for (std::size_t k = 0; k < times.size(); ++k) {
        if (targets.target[k] != MorphTargets::npos)
          weights[k * (before[i] + count) + before[i] + targets.target[k]] = 1;
      }
      made["samplers"].push_back(
          {{"input", input}, {"interpolation", "LINEAR"}, {"output", add_numbers(weights, false)}});
    }
    made["channels"].push_back(
        {{"sampler", at->second}, {"target", {{"node", nodes[i]}, {"path", "weights"}}}});
  }
  document_["animations"].push_back(std::move(made));
}

}  // namespace viete::mesh
