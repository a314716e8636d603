#include "mesh/formats/gltf_morphs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "mesh/formats/gltf_accessors.h"
#include "mesh/formats/gltf_json.h"
#include "mesh/formats/written_positions.h"

namespace viete::mesh {

namespace {

using Numbers = std::vector<double>;
using SharedNumbers = std::shared_ptr<const Numbers>;

// How the weights of one node go.
struct WeightTrack {
  enum class Way { linear, step, cubic };
  SharedNumbers times,
      values;  // values: of every time as many as there are targets, three times that in cubic
  Way way = Way::linear;

  Numbers at(double t, std::size_t count) const;

private:
  double value(std::size_t key, std::size_t part, std::size_t target, std::size_t count) const {
    const std::size_t parts = way == Way::cubic ? 3 : 1;
    return (*values)[(key * parts + part) * count + target];
  }
};

Numbers WeightTrack::at(double t, std::size_t count) const {
  const auto next = std::upper_bound(times->begin(), times->end(), t);
  const std::size_t b = static_cast<std::size_t>(next - times->begin()), a = b == 0 ? 0 : b - 1;
  const bool alone = b == 0 || b == times->size();
  const double span = alone ? 1 : (*times)[b] - (*times)[a], u = alone ? 0 : (t - (*times)[a]) / span;
  const std::size_t middle = way == Way::cubic ? 1 : 0;
  Numbers weights(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double from = value(a, middle, i, count);
    weights[i] = from;
    if (alone || way == Way::step) continue;
    const double to = value(b, middle, i, count);
    if (way == Way::linear) {
      weights[i] = from + u * (to - from);
      continue;
    }
    const double out = span * value(a, 2, i, count), in = span * value(b, 0, i, count);  // Hermite's cubic
    const double u2 = u * u, u3 = u2 * u;
    weights[i] =
        (2 * u3 - 3 * u2 + 1) * from + (u3 - 2 * u2 + u) * out + (3 * u2 - 2 * u3) * to + (u3 - u2) * in;
  }
  return weights;
}

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
    times_of_.clear();
  }

  std::vector<Point> at_key(std::size_t key) const override {
    std::vector<Numbers> weights;
    for (std::size_t p = 0; p < counts_.size(); ++p)
      weights.push_back(tracks_[p] ? tracks_[p]->at(seconds_[key], counts_[p]) : resting_[p]);
    return positions(weights);
  }

  std::vector<Point> at_target(std::size_t target) const override {
    std::vector<Numbers> weights;
    for (const std::size_t count : counts_) {
      weights.emplace_back(count, 0);
      if (target < count) weights.back()[target] = 1;
    }
    return positions(weights);
  }

private:
  // The names of its targets, and its weights where nothing plays.
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

  // Accessors that many channels share are read once.
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
        const std::string path = text_of(member_of(channel, "target"), "path");
        if (path != "weights") {
          moves_nodes = true;
        } else if (!played) {
          has_weights |= take_channel(a, channel);
        } else {
          has_weights = true;
        }
      }
      if (has_weights && played) ++other;
      if (has_weights && !played) name_ = text_of(animations[a], "name");
      played |= has_weights;
    }
    if (other > 0)
      notes_.push_back("of " + base::counted(other + 1, "animation") + " of weights the first one is taken");
    if (moves_nodes) notes_.emplace_back("what its animations do to nodes (bones, places) is not played");
    if (is_curved_) notes_.emplace_back("weights that jump or follow curves go straight from key to key");
  }

  bool take_channel(std::size_t animation, const GltfJson& channel) {
    const auto node = count_of(member_of(channel, "target"), "node");
    const auto sampler = count_of(channel, "sampler");
    const GltfJson& samplers = list_of(list_of(document_, "animations")[animation], "samplers");
    const auto fail = [&](const std::string& problem) {
      throw base::Error(file_->name + ": animation " + std::to_string(animation), problem,
                        "export the model again");
    };
    if (!sampler || *sampler >= samplers.size()) fail("has a channel of a sampler that is not there");
    const auto input = count_of(samplers[*sampler], "input"), output = count_of(samplers[*sampler], "output");
    const std::size_t all = list_of(document_, "accessors").size();
    if (!input || !output || *input >= all || *output >= all)
      fail("has a sampler of accessors that are not there");
    const std::string way = text_of(samplers[*sampler], "interpolation");
    WeightTrack track;
    track.way = way == "STEP"          ? WeightTrack::Way::step
                : way == "CUBICSPLINE" ? WeightTrack::Way::cubic
                                       : WeightTrack::Way::linear;
    track.times = numbers(static_cast<int>(*input));
    track.values = numbers(static_cast<int>(*output));
    const bool is_new = seen_times_.insert(static_cast<int>(*input)).second;
    for (std::size_t i = 0; i < track.times->size() && is_new; ++i) {
      const double t = (*track.times)[i];
      if (!std::isfinite(t) || (i > 0 && t <= (*track.times)[i - 1])) fail("has times that do not ascend");
    }
    for (const double value : *track.values) {
      if (!std::isfinite(value)) fail("has a weight that is no number");
    }
    bool used = false;
    for (std::size_t p = 0; p < counts_.size(); ++p) {
      if (!node || static_cast<std::uint64_t>(map_->placements[p].node) != *node || counts_[p] == 0) continue;
      const std::size_t parts = track.way == WeightTrack::Way::cubic ? 3 : 1;
      if (track.values->size() != track.times->size() * parts * counts_[p])
        fail("has " + std::to_string(track.values->size()) + " weights for " +
             base::counted(track.times->size(), "time") + " and " + base::counted(counts_[p], "target"));
      tracks_[p] = track;
      used = true;
    }
    if (!used) return false;
    is_curved_ |= track.way != WeightTrack::Way::linear;
    if (is_new) add_times(*track.times);
    return true;
  }

  void add_times(const Numbers& times) {
    Numbers all;
    std::ranges::set_union(seconds_, times, std::back_inserter(all));
    seconds_ = std::move(all);
  }

  std::vector<Point> positions(const std::vector<Numbers>& weights) const {
    std::size_t vertices = 0;
    for (const std::uint32_t v : map_->surface_vertex) vertices = std::max(vertices, std::size_t{v} + 1);
    std::vector<Point> result(vertices);
    std::vector<char> is_placed(vertices, 0);
    for (const GltfPiece& piece : map_->pieces) {
      Numbers numbers = accessors_.numbers(piece.positions, 3);
      const Numbers added =
          morph_differences(accessors_, piece, &GltfTarget::positions, weights[piece.placement]);
      for (std::size_t k = 0; k < added.size(); ++k) numbers[k] += added[k];
      for (std::size_t k = 0; k < piece.count; ++k) {
        const std::uint32_t v = map_->surface_vertex[piece.first + k];
        if (std::exchange(is_placed[v], 1) != 0) continue;
        const Point p = map_->placements[piece.placement].map.of_point(
            {numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]});
        if (!is_place(p))
          accessors_.fail("accessor", piece.positions,
                          "morphs position " + std::to_string(k) + " to no place");
        result[v] = p;
      }
    }
    return result;
  }

  std::shared_ptr<const GltfFile> file_;
  std::shared_ptr<const GltfMap> map_;
  GltfAccessors accessors_;
  const GltfJson& document_;
  std::vector<std::size_t> counts_;                 // targets of each placement
  std::vector<Numbers> resting_;                    // their weights where nothing plays
  std::vector<std::optional<WeightTrack>> tracks_;  // and where the animation does
  std::map<int, SharedNumbers> times_of_;
  std::set<int> seen_times_;
  bool is_curved_ = false;
};

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

}  // namespace viete::mesh
