#include "formats/gltf_morphs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/text.h"

namespace viete::formats {

namespace {

using Numbers = std::vector<double>;
using SharedNumbers = std::shared_ptr<const Numbers>;

// The animated weights of one node.
struct WeightTrack {
  SharedNumbers times, values;  // for each time, one number per target; for `cubic`, three: see cubic_at()
  MorphCurve curve = MorphCurve::linear;

  Numbers at(double t, std::size_t count) const {
    const auto next = std::upper_bound(times->begin(), times->end(), t);
    const std::size_t after = static_cast<std::size_t>(next - times->begin()), a = after == 0 ? 0 : after - 1,
                      b = curve == MorphCurve::held ? a : std::min(after, times->size() - 1);
    const double span = (*times)[b] - (*times)[a], u = span > 0 ? (t - (*times)[a]) / span : 0;
    Numbers weights(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (curve == MorphCurve::other) {
        weights[i] = cubic_at(3 * a * count + i, 3 * b * count + i, count, span, u);
      } else {
        const double from = (*values)[a * count + i], to = (*values)[b * count + i];
        weights[i] = from + u * (to - from);
      }
    }
    return weights;
  }

  bool changes_between(double from, double to) const { return times->front() < to && times->back() > from; }

private:
  // CUBICSPLINE of glTF 2.0, appendix C: each key has in-tangents, values and out-tangents of all targets.
  double cubic_at(std::size_t a, std::size_t b, std::size_t count, double span, double u) const {
    const double uu = u * u, uuu = uu * u;
    const double out = (*values)[a + 2 * count], in = (*values)[b];
    return (2 * uuu - 3 * uu + 1) * (*values)[a + count] + span * (uuu - 2 * uu + u) * out +
           (3 * uu - 2 * uuu) * (*values)[b + count] + span * (uuu - uu) * in;
  }
};

class GltfMorphClip final : public MorphClip {
public:
  GltfMorphClip(std::shared_ptr<const GltfFile> file, std::shared_ptr<const GltfMap> map)
      : file_(std::move(file)),
        map_(std::move(map)),
        accessors_(*file_),
        document_(file_->document),
        counts_(map_->placements.size(), 0),
        resting_(map_->placements.size()),
        tracks_(map_->placements.size()) {
    for (const GltfPiece& piece : map_->pieces)
      counts_[piece.placement] = std::max(counts_[piece.placement], piece.targets->size());
    for (std::size_t p = 0; p < counts_.size(); ++p) take_placement(p);
    take_animations();
    take_curves();
    times_of_.clear();
  }

  std::vector<mesh::Point> at(double second) const override {
    std::vector<Numbers> weights;
    for (std::size_t p = 0; p < counts_.size(); ++p)
      weights.push_back(tracks_[p] ? tracks_[p]->at(second, counts_[p]) : resting_[p]);
    return positions(weights);
  }

  std::vector<mesh::Point> at_target(std::size_t target) const override {
    std::vector<Numbers> weights;
    for (const std::size_t count : counts_) {
      weights.emplace_back(count, 0);
      if (target < count) weights.back()[target] = 1;
    }
    return positions(weights);
  }

private:
  void take_placement(std::size_t p) {
    const GltfPlacement& placement = map_->placements[p];
    resting_[p] = default_weights(document_, placement, counts_[p]);
    const GltfJson& mesh = element_of(document_, "meshes", placement.mesh);
    const GltfJson& names = list_of(member_of(mesh, "extras"), "targetNames");
    for (std::size_t i = targets_.size(); i < counts_[p]; ++i) {
      const bool named = i < names.size() && names[i].is_string() && !names[i].get<std::string>().empty();
      targets_.push_back(named ? names[i].get<std::string>() : "target " + std::to_string(i + 1));
    }
  }

  // Reads each accessor only once, because many channels can use the same accessor.
  SharedNumbers numbers(int accessor) {
    SharedNumbers& known = times_of_[accessor];
    if (!known) known = std::make_shared<const Numbers>(accessors_.numbers(accessor, 1));
    return known;
  }

  void take_animations() {
    const GltfJson& animations = list_of(document_, "animations");
    std::size_t other = 0;
    bool played = false, moves_nodes = false;
    for (std::size_t a = 0; a < animations.size(); ++a) {
      bool has_weights = false;
      for (const GltfJson& channel : list_of(animations[a], "channels")) {
        if (text_of(member_of(channel, "target"), "path") != "weights")
          moves_nodes = true;
        else
          has_weights |= played || take_channel(a, channel);
      }
      if (has_weights && played) ++other;
      if (has_weights && !played) name_ = text_of(animations[a], "name");
      played |= has_weights;
    }
    if (other > 0)
      notes_.push_back("only the first of " + base::counted(other + 1, "animation") + " of weights is used");
    if (moves_nodes) notes_.emplace_back("animations of nodes (bones, transforms) are ignored");
  }

  void take_curves() {
    for (std::size_t k = 0; k + 1 < seconds_.size(); ++k) {
      std::optional<MorphCurve> curve;
      for (const auto& track : tracks_) {
        if (!track || !track->changes_between(seconds_[k], seconds_[k + 1])) continue;
        curve = !curve || *curve == track->curve ? track->curve : MorphCurve::other;
      }
      curves_.push_back(curve.value_or(MorphCurve::held));
    }
  }

  bool take_channel(std::size_t animation, const GltfJson& channel) {
    const auto node = count_of(member_of(channel, "target"), "node");
    const auto sampler = count_of(channel, "sampler");
    const GltfJson& samplers = list_of(list_of(document_, "animations")[animation], "samplers");
    const auto fail = [&](const std::string& problem) {
      throw base::Error(file_->name + ": animation " + std::to_string(animation), problem,
                        "export the model again");
    };
    if (!sampler || *sampler >= samplers.size()) fail("has a channel whose sampler does not exist");
    const auto input = count_of(samplers[*sampler], "input"), output = count_of(samplers[*sampler], "output");
    const std::size_t all = list_of(document_, "accessors").size();
    if (!input || !output || *input >= all || *output >= all)
      fail("has a sampler whose accessors do not exist");
    const std::string interpolation = text_of(samplers[*sampler], "interpolation");
    const MorphCurve curve = interpolation == "CUBICSPLINE" ? MorphCurve::other
                             : interpolation == "STEP"      ? MorphCurve::held
                                                            : MorphCurve::linear;
    const std::size_t parts = curve == MorphCurve::other ? 3 : 1;
    const WeightTrack track{numbers(static_cast<int>(*input)), numbers(static_cast<int>(*output)), curve};
    const bool is_new = seen_times_.insert(static_cast<int>(*input)).second;
    for (std::size_t i = 0; i < track.times->size() && is_new; ++i) {
      const double t = (*track.times)[i];
      if (!std::isfinite(t) || (i > 0 && t <= (*track.times)[i - 1])) fail("has times that do not increase");
    }
    for (const double value : *track.values)
      if (!std::isfinite(value)) fail("has a weight that is not finite");
    bool used = false;
    for (std::size_t p = 0; p < counts_.size(); ++p) {
      if (!node || static_cast<std::uint64_t>(map_->placements[p].node) != *node || counts_[p] == 0) continue;
      if (track.values->size() != track.times->size() * parts * counts_[p])
        fail("has " + std::to_string(track.values->size()) + " weights for " +
             base::counted(track.times->size(), "time") + " and " + base::counted(counts_[p], "target"));
      tracks_[p] = track;
      used = true;
    }
    if (!used) return false;
    if (is_new) add_times(*track.times);
    return true;
  }

  void add_times(const Numbers& times) {
    Numbers all;
    std::ranges::set_union(seconds_, times, std::back_inserter(all));
    seconds_ = std::move(all);
  }

  std::vector<mesh::Point> positions(const std::vector<Numbers>& weights) const {
    std::size_t vertices = 0;
    for (const std::uint32_t v : map_->surface_vertex) vertices = std::max(vertices, std::size_t{v} + 1);
    std::vector<mesh::Point> result(vertices);
    std::vector<char> is_placed(vertices, 0);
    for (const GltfPiece& piece : map_->pieces) {
      Numbers numbers = accessors_.numbers(piece.positions, 3);
      const Numbers added =
          morph_differences(accessors_, piece, &GltfTarget::positions, weights[piece.placement]);
      for (std::size_t k = 0; k < added.size(); ++k) numbers[k] += added[k];
      for (std::size_t k = 0; k < piece.count; ++k) {
        const std::uint32_t v = map_->surface_vertex[piece.first + k];
        if (std::exchange(is_placed[v], 1) != 0) continue;
        const mesh::Point p = map_->placements[piece.placement].map.of_point(
            {numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]});
        if (!is_place(p))
          accessors_.fail("accessor", piece.positions,
                          "morphed position " + std::to_string(k) + " is not a finite number up to 1e100");
        result[v] = p;
      }
    }
    return result;
  }

  std::shared_ptr<const GltfFile> file_;
  std::shared_ptr<const GltfMap> map_;
  GltfAccessors accessors_;
  const GltfJson& document_;
  std::vector<std::size_t> counts_;                 // for each placement, the number of targets
  std::vector<Numbers> resting_;                    // for each placement, the default weights
  std::vector<std::optional<WeightTrack>> tracks_;  // for each placement, the animated weights or nullopt
  std::map<int, SharedNumbers> times_of_;
  std::set<int> seen_times_;
};

void widen_list(GltfJson& of, std::size_t count) {
  GltfJson& weights = of["weights"];
  if (!weights.is_array()) weights = GltfJson::array();
  while (weights.size() < count) weights.push_back(0);
}

}  // namespace

std::vector<double> default_weights(const GltfJson& document, const GltfPlacement& placement,
                                    std::size_t count) {
  std::vector<double> weights(count, 0);
  const GltfJson& own = list_of(element_of(document, "nodes", placement.node), "weights");
  const GltfJson& given =
      own.empty() ? list_of(element_of(document, "meshes", placement.mesh), "weights") : own;
  for (std::size_t i = 0; i < std::min(count, given.size()); ++i) {
    const double weight = given[i].is_number() ? given[i].get<double>() : 0.0;
    if (std::isfinite(weight)) weights[i] = weight;
  }
  return weights;
}

std::vector<double> morph_differences(const GltfAccessors& accessors, const GltfPiece& piece,
                                      int GltfTarget::*of, std::span<const double> weights) {
  Numbers sum;
  for (std::size_t t = 0; t < std::min(piece.targets->size(), weights.size()); ++t) {
    const int accessor = (*piece.targets)[t].*of;
    if (weights[t] == 0 || accessor < 0) continue;
    const std::size_t count = accessors.count(accessor);
    if (count != piece.count)
      accessors.fail(
          "accessor", accessor,
          "has " + std::to_string(count) + " differences for " + std::to_string(piece.count) + " positions");
    const Numbers differences = accessors.numbers(accessor, 3);
    sum.resize(differences.size(), 0);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weights[t] * differences[i];
  }
  return sum;
}

std::shared_ptr<const MorphClip> gltf_morphs(std::shared_ptr<const GltfFile> file,
                                             std::shared_ptr<const GltfMap> map) {
  auto clip = std::make_shared<const GltfMorphClip>(std::move(file), std::move(map));
  return clip->targets().empty() ? nullptr : clip;
}

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

std::size_t GltfMorphs::targets_of(std::size_t node) const {
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

// Adds an accessor and returns its index. If a sparse accessor is smaller, stores only the nonzero elements.
// If all elements are zero, stores the last one, because a sparse accessor must have an element.
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
  constexpr std::size_t cost = 128;  // estimated bytes of JSON for a sparse accessor
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

// Appends `added` zeros to each key's weights, in a copy of the sampler, because nodes can share samplers.
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
  if (!extras.is_object()) return;  // extras are custom data of another program
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
  std::map<std::vector<double>, std::size_t> samplers;  // key: the default weights of the older targets
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

}  // namespace viete::formats
