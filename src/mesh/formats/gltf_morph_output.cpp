#include "mesh/formats/gltf_morph_output.h"

#include <algorithm>
#include <cstdint>
#include <map>

#include "base/error.h"
#include "mesh/formats/gltf_morphs.h"
#include "mesh/formats/written_positions.h"

namespace viete::mesh {

namespace {

// Zeros for as many more targets as there are now.
void widen_list(GltfJson& of, std::size_t count) {
  GltfJson& weights = of["weights"];
  if (!weights.is_array()) weights = GltfJson::array();
  while (weights.size() < count) weights.push_back(0);
}

}  // namespace

std::size_t add_gltf_view(GltfJson& document, std::string& bytes, const void* data, std::size_t size,
                          std::size_t buffer) {
  bytes.resize((bytes.size() + 3) / 4 * 4);
  document["bufferViews"].push_back({{"buffer", buffer}, {"byteOffset", bytes.size()}, {"byteLength", size}});
  bytes.append(static_cast<const char*>(data), size);
  return document["bufferViews"].size() - 1;
}

void set_gltf_bounds(GltfJson& accessor, std::span<const float> values, std::size_t components) {
  const auto first = values.first(components);
  std::vector<float> low(first.begin(), first.end()), high = low;
  for (std::size_t i = 0; i < values.size(); ++i) {
    low[i % components] = std::min(low[i % components], values[i]);
    high[i % components] = std::max(high[i % components], values[i]);
  }
  accessor["min"] = low;
  accessor["max"] = high;
}

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

std::size_t GltfMorphs::add_deltas(std::span<const float> base, std::span<const double> now) {
  std::vector<float> deltas(base.size());
  for (std::size_t i = 0; i < deltas.size(); ++i) {
    deltas[i] = static_cast<float>(now[i] - static_cast<double>(base[i]));
    if (i % 3 == 2) check_written("glTF", i / 3, {deltas[i - 2], deltas[i - 1], deltas[i]}, largest_float);
  }
  return add_floats(deltas, 3);
}

// Of zeros but for a few these alone: a sparse accessor has one value at least.
std::size_t GltfMorphs::add_floats(std::span<const float> values, std::size_t parts) {
  const std::size_t count = values.size() / parts;
  std::vector<float> some;
  std::vector<std::uint32_t> where;
  for (std::size_t i = 0; i < count; ++i) {
    const auto element = values.subspan(i * parts, parts);
    const bool is_zero = std::ranges::all_of(element, [](float x) { return x == 0; });
    if (is_zero && (i + 1 < count || !where.empty())) continue;
    where.push_back(static_cast<std::uint32_t>(i));
    some.insert(some.end(), element.begin(), element.end());
  }
  GltfJson accessor = {{"componentType", gltf_float}, {"count", count}};
  accessor["type"] = parts == 3 ? "VEC3" : "SCALAR";
  const std::size_t index_size = count <= std::size_t{1} << 16 ? 2 : 4;
  constexpr std::size_t cost = 128;  // in the text
  if (where.size() * (index_size + 4 * parts) + cost < 4 * values.size()) {
    accessor["sparse"] = sparse(where, some, index_size);
  } else {
    accessor["bufferView"] = add_gltf_view(document_, bytes_, values.data(), values.size_bytes());
  }
  set_gltf_bounds(accessor, values, parts);
  document_["accessors"].push_back(std::move(accessor));
  return document_["accessors"].size() - 1;
}

GltfJson GltfMorphs::sparse(std::span<const std::uint32_t> where, std::span<const float> some,
                            std::size_t index_size) {
  const bool is_short = index_size == 2;
  const std::vector<std::uint16_t> shorts(is_short ? where.begin() : where.end(), where.end());
  const std::size_t indices =
      add_gltf_view(document_, bytes_, is_short ? static_cast<const void*>(shorts.data()) : where.data(),
                    index_size * where.size());
  return {{"count", where.size()},
          {"indices",
           {{"bufferView", indices}, {"componentType", is_short ? gltf_unsigned_short : gltf_unsigned_int}}},
          {"values", {{"bufferView", add_gltf_view(document_, bytes_, some.data(), some.size_bytes())}}}};
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
  const std::size_t accessor = add_floats(wide, 1);
  GltfJson& animation = document_["animations"][output.animation];
  GltfJson& channel = animation["channels"][output.channel];
  GltfJson sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
  sampler["output"] = accessor;
  channel["sampler"] = animation["samplers"].size();
  animation["samplers"].push_back(std::move(sampler));
}

void GltfMorphs::name_targets(const MorphMotion& motion, std::size_t node, std::size_t before) {
  GltfJson& mesh = mesh_of(node);
  widen_list(mesh, before + motion.targets.size());
  GltfJson& placed = document_["nodes"][node];
  if (placed.contains("weights")) widen_list(placed, before + motion.targets.size());
  GltfJson& extras = mesh["extras"];
  if (extras.is_null()) extras = GltfJson::object();
  if (!extras.is_object()) return;  // somebody's own
  GltfJson& names = extras["targetNames"];
  if (!names.is_array()) names = GltfJson::array();
  while (names.size() < before) names.push_back("target " + std::to_string(names.size() + 1));
  for (const std::string& name : motion.targets)
    names.push_back(name.empty() ? "target " + std::to_string(names.size() + 1) : name);
}

void GltfMorphs::animate(const MorphMotion& motion, std::span<const std::size_t> nodes,
                         std::span<const std::size_t> before) {
  if (nodes.empty()) return;
  const std::vector<float> times(motion.seconds.begin(), motion.seconds.end());
  const std::size_t input = add_floats(times, 1), count = motion.targets.size();
  GltfJson made = {{"name", motion.name}, {"channels", GltfJson::array()}, {"samplers", GltfJson::array()}};
  std::map<std::vector<double>, std::size_t> samplers;  // by the weights of targets before ours
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const GltfPlacement placement{
        static_cast<int>(nodes[i]), index_of(document_["nodes"][nodes[i]], "mesh"), {}};
    const std::vector<double> others = default_weights(document_, placement, before[i]);
    const auto [at, added] = samplers.try_emplace(others, made["samplers"].size());
    if (added) {
      std::vector<float> weights;
      for (std::size_t k = 0; k < times.size(); ++k) {
        weights.insert(weights.end(), others.begin(), others.end());
        const auto own = motion.weights.begin() + static_cast<std::ptrdiff_t>(k * count);
        weights.insert(weights.end(), own, own + static_cast<std::ptrdiff_t>(count));
      }
      made["samplers"].push_back(
          {{"input", input}, {"interpolation", "LINEAR"}, {"output", add_floats(weights, 1)}});
    }
    made["channels"].push_back(
        {{"sampler", at->second}, {"target", {{"node", nodes[i]}, {"path", "weights"}}}});
  }
  document_["animations"].push_back(std::move(made));
}

}  // namespace viete::mesh
